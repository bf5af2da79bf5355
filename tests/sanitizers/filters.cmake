# Which tests run under sanitizers, as GoogleTest's filters; the rest of `image` is for the label long.
# Left out of `unit`: what measures or limits memory, which sanitizers take much of, and what a program may link.
set(unit_sanitized "-MemoryLimit*:ReplayLinks*:DyingDrivers*")
# Of `image` the host's own work: the command line, films, resuming, merging, captures, faults of devices. Left out are long
# renders, which are kernels' time, and limits of address space, which sanitizers reserve.
set(image_sanitized "RenderCommand.*:ResumeCommand.*:ReconstructCommand.*:Frames.*:ImageLightCommand.*")
set(image_sanitized_rest "-${image_sanitized}:ShellLimits.*")
set(device_sanitized "*")
set(fuzz_sanitized "*")

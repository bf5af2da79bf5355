# Which tests run under sanitizers, as GoogleTest's filters; the rest of `image` is for the label long.
# Left out of `unit`: what measures or limits memory, which sanitizers take much of; what a program may link; drivers that die on
# purpose; where no file may grow, the thread sanitizer, which writes one before a program starts, and what its `new` does not do. For the label long: long sums,
# which are arithmetic alone.
set(unit_unsuited "MemoryLimit*:ReplayLinks*:DyingDrivers*:StandardIncludes*")
if(TRIAD_SANITIZE STREQUAL "thread")
  string(APPEND unit_unsuited ":CommandLine.a_full_disk_leaves_an_older_report_as_it_was:HugePages.*")
endif()
set(unit_sums "PublishedErrors*:TileMetric.*:Repetitions.intervals*:KeptTaps.are_what*:Borders.tell*:PanelChart.has_the_fewest*:PerceivedCommand.*:Refine.*:Schedule.the_error*:Schedule.estimates*:Optimum.*:MeanTest.*:CompareMaps.*:ComparePictures.*:PanelCommand.*:SubpixelBench.*")
set(unit_sanitized "-${unit_unsuited}:${unit_sums}")
set(unit_sanitized_rest "${unit_sums}")
# Of `image` the host's own work: the command line, films, resuming, merging, captures, faults of devices. Left out are long
# renders, which are kernels' time, and limits of address space and of memory, of which sanitizers take much.
set(image_of_host "RenderCommand.*:MergeCommand.*:MemoryUse.what*:Scenes.*:ResumeCommand.*:ReconstructCommand.*:Frames.*:ImageLightCommand.*")
set(image_sanitized "${image_of_host}")
set(image_sanitized_rest "-${image_of_host}:MemoryUse.*:ShellLimits.*")
set(device_sanitized "*")
set(fuzz_sanitized "*")

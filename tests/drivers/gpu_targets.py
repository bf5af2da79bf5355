"""The compilers of real GPUs: one program of kernels/ in, what each of its kernels takes out.

A target's preprocess() gives the text that decides the result, its compile() runs the compiler. Figures of a kernel:
registers, stack (bytes of private memory per work-item, of the functions it calls too), spills (bytes of spill stores; on
Intel the compiler's own count) and width (warps of 64 on NVIDIA and waves of 8, 10 or 16 on AMD that fit beside each other
by their registers; the SIMD width on Intel)."""
import inspect
import os
import re
import resource
import signal
import subprocess

# What the host passes everywhere, docs/kernels.md.
FLAGS = ["-cl-std=CL1.2", "-cl-fp32-correctly-rounded-divide-sqrt"]
DENORMALS = "-cl-denorms-are-zero"
TIME_LIMIT = 600  # seconds of the processor, for one compilation


class Failure(Exception):
    """A compiler that crashed (a signal, or its own handler of one) or refused a program."""

    def __init__(self, crashed, text):
        super().__init__(text)
        self.crashed = crashed


def run(command, environment=None):
    done = subprocess.run(command, env=environment, text=True, errors="replace", stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (TIME_LIMIT, TIME_LIMIT + 5)))
    if done.returncode == -signal.SIGXCPU:
        raise Failure(False, f"not done after {TIME_LIMIT} s")
    if done.returncode < 0:
        raise Failure(True, signal.Signals(-done.returncode).name)
    if done.returncode or "error:" in done.stdout:
        crashed = "PLEASE submit a bug report" in done.stdout
        raise Failure(crashed, done.stdout.strip() or f"exit {done.returncode}")
    return done.stdout


def clang(target, kernels, program, defines, *more):
    return run(["clang-15", "-target", *target, "-x", "cl", *FLAGS, f"-I{kernels}", *defines, *more, f"{kernels}/{program}"])


def reachable(bodies, name):
    """Functions that are named in the body of `name`, or in theirs."""
    found, waiting = set(), [name]
    while waiting:
        one = waiting.pop()
        if one in found:
            continue
        found.add(one)
        waiting += set(re.findall(r"[A-Za-z_]\w*", bodies.get(one, ""))) & bodies.keys()
    return found


class Nvidia:
    """Clang writes PTX, and NVIDIA's own ptxas compiles that as its driver does."""

    def __init__(self, name, virtual, ptxas):
        self.name, self.ptxas = name, ptxas
        self.target = ["nvptx64--nvidiacl", f"-march={virtual}"]
        self.version = run(["clang-15", "--version"]).splitlines()[0] + ", ptxas " + run([ptxas, "--version"]).split()[-1]

    def preprocess(self, kernels, program, defines):
        return clang(self.target, kernels, program, defines, "-E", "-P")

    def compile(self, kernels, program, defines, folder):
        ptx = f"{folder}/program.ptx"
        # Clang takes the flag about denormals for AMD alone; this is what it does there.
        clang(self.target, kernels, program, defines, "-O3", "-S", "-o", ptx, "-Xclang", "-finclude-default-header",
              "-Xclang", "-fdenormal-fp-math-f32=preserve-sign,preserve-sign",
              "-Xclang", "-mlink-builtin-bitcode", "-Xclang", "/usr/lib/clc/nvptx64--nvidiacl.bc")
        log = run([self.ptxas, f"-arch={self.name}", "-v", ptx, "-o", f"{folder}/program.cubin"])
        with open(ptx, encoding="utf-8") as file:
            parts = re.split(r"^(?:\.visible )?\.(?:entry|func) +(?:\([^)]*\) *)?(\w+)\s*\(", file.read(), flags=re.M)
        # A function may be declared before it is defined: bodies of one name are joined.
        bodies = {}
        for name, body in zip(parts[1::2], parts[2::2]):
            bodies[name] = bodies.get(name, "") + body
        stores = {name: int(n) for name, n in
                  re.findall(r"Function properties for (\w+)\n.*?(\d+) bytes spill stores", log)}
        kernels_of = re.findall(r"entry function '(\w+)'.*?Used (\d+) registers(.*?)$", log, flags=re.M | re.S)
        return {name: {"registers": int(registers),
                       "stack": int((re.search(r"(\d+) bytes cumulative stack", rest) or [0, 0])[1]),
                       "spills": sum(stores.get(f, 0) for f in reachable(bodies, name)),
                       "width": self.warps(int(registers))} for name, registers, rest in kernels_of}

    @staticmethod
    def warps(registers):
        """65536 registers, given out by 8 to each of a warp's 32 lanes, to four warps at a time."""
        return min(64, 65536 // (-(-registers // 8) * 8 * 32) // 4 * 4)


class Amd:
    """Clang with AMD's device library: the same compiler family as AMD's drivers."""

    library = "--rocm-device-lib-path=/usr/lib/x86_64-linux-gnu/amdgcn/bitcode"

    def __init__(self, name):
        self.name = name
        self.target = ["amdgcn-amd-amdhsa", f"-mcpu={name}", DENORMALS]
        self.version = run(["clang-15", "--version"]).splitlines()[0]

    def preprocess(self, kernels, program, defines):
        return clang(self.target, kernels, program, defines, "-nogpulib", "-E", "-P")

    def compile(self, kernels, program, defines, folder):
        path = f"{folder}/program.s"
        clang(self.target, kernels, program, defines, self.library, "-O3", "-S", "-o", path, "-Xclang",
              "-finclude-default-header")
        with open(path, encoding="utf-8") as file:
            text = file.read()
        parts = re.split(r"^(\w+): +; @\w+$", text, flags=re.M)
        whole = dict(zip(parts[1::2], parts[2::2]))
        bodies = {name: body.split("\n.Lfunc_end", 1)[0] for name, body in whole.items()}
        spilled = {name: sum(map(int, re.findall(r"store\w* .*; (\d+)-byte Folded Spill", body)))
                   for name, body in bodies.items()}
        found = {}
        for about in text[text.index("amdhsa.kernels:"):].split("\n  - .args:")[1:]:
            name = re.search(r"\.name: +(\w+)\n +\.private", about)[1]
            found[name] = {"registers": int(re.search(r"\.vgpr_count: +(\d+)", about)[1]),
                           "stack": int(re.search(r"\.private_segment_fixed_size: +(\d+)", about)[1]),
                           "spills": sum(spilled[f] for f in reachable(bodies, name)),
                           "width": int(re.search(r"; Occupancy: (\d+)", whole[name])[1])}
        return found


class Intel:
    """ocloc of Debian 12: the very compiler that its users' drivers have."""

    def __init__(self, name, root):
        self.name, self.ocloc = name, f"{root}/usr/bin/ocloc"
        self.environment = dict(os.environ, LD_LIBRARY_PATH=f"{root}/usr/lib/x86_64-linux-gnu")
        packages = " ".join(os.listdir(f"{root}/packages"))
        self.version = "Intel's compiler " + re.search(r"libigc1_([^_]+)", packages)[1]

    def preprocess(self, kernels, program, defines):
        return clang(["spir64"], kernels, program, defines, "-E", "-P")

    def compile(self, kernels, program, defines, folder):
        # zebin holds the same code as the older format that this driver reads, and says in words what a kernel takes.
        log = run([self.ocloc, "compile", "-file", f"{kernels}/{program}", "-device", self.name, "-out_dir", folder,
                   "--format", "zebin", "-options", " ".join([*FLAGS, DENORMALS, f"-I{kernels}", *defines])],
                  self.environment)
        binary = next(f for f in os.listdir(folder) if f.endswith(".bin"))
        with open(f"{folder}/{binary}", "rb") as file:
            text = file.read().decode("latin1")
        text = text[text.index("\nkernels:\n"):].split("\nkernels_misc_info:")[0].split("\n...")[0]
        spilled = dict(re.findall(r"kernel (\w+) +compiled SIMD\d+ allocated \d+ regs and spilled around (\d+)", log))
        found = {}
        for about in text.split("\n  - name: ")[1:]:
            name = about.split()[0]
            width = int(re.search(r"simd_size: +(\d+)", about)[1])
            found[name] = {"registers": int(re.search(r"grf_count: +(\d+)", about)[1]),
                           "stack": sum(self.private_bytes(about, width)),
                           "spills": int(spilled.get(name, 0)), "width": width}
        return found

    @staticmethod
    def private_bytes(about, width):
        """Of a work-item: memory is said per hardware thread, which does `width` of them, or per work-item."""
        for buffer in about.partition("per_thread_memory_buffers:")[2].split("- type:")[1:]:
            size = int(re.search(r"\n +size: +(\d+)", buffer)[1])
            yield size if re.search(r"is_simt_thread: +true", buffer) else size // width


def identity(target):
    """All of a compilation but the text: a result may be kept as long as this is the same."""
    return "\0".join([target.name, target.version, *FLAGS, DENORMALS, inspect.getsource(clang), inspect.getsource(type(target))])


def targets(ptxas, intel, long):
    """Those of every run, and with `long` the rest."""
    yield Nvidia("sm_90", "sm_80", ptxas)
    yield Amd("gfx1030")
    yield Intel("tgllp", intel)
    if long:
        yield Nvidia("sm_70", "sm_70", ptxas)
        yield from (Amd(name) for name in ("gfx900", "gfx1100"))
        yield from (Intel(name, intel) for name in ("skl", "dg2", "pvc"))


def knows(target, folder):
    """Whether the compiler and its library know the target at all."""
    with open(f"{folder}/empty.cl", "w", encoding="utf-8") as file:
        file.write("kernel void nothing(global int* a) { *a = 1; }\n")
    try:
        return bool(target.compile(folder, "empty.cl", [], folder))
    except Failure:
        return False


def timed(target, kernels, program, defines, folder):
    """Figures by kernel, and the processor's seconds that they took; of a process that compiles nothing else meanwhile."""
    def seconds():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    start = seconds()
    found = target.compile(kernels, program, defines, folder)
    return found, seconds() - start

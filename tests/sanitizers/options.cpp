// What sanitizers are told, in every program that is built with them. Suppressed is third-party code alone,
// by name.

extern "C" {

// Triad's own `delete` (base/memory_limit.h) frees what the sanitizer's `new` gave. What is too large is a
// std::bad_alloc, which has its sentence. Leaks are looked for by fuzz targets: the sanitizer's search for
// them stops all threads when a program ends, and crashes on those of PoCL.
const char* __asan_default_options() {
    return "detect_stack_use_after_return=1:alloc_dealloc_mismatch=0:allocator_may_return_null=1:detect_"
           "leaks=0";
}

const char* __ubsan_default_options() { return "halt_on_error=1:print_stacktrace=1"; }

const char* __lsan_default_options() { return "print_suppressions=0"; }

const char* __lsan_default_suppressions() {
    return "leak:libpocl\n"
           "leak:libLLVM\n";
}

// Drivers, their compilers and their threads are not instrumented: what they lock and unlock is no business
// of the thread sanitizer's.
const char* __tsan_default_options() { return "ignore_noninstrumented_modules=1"; }
}

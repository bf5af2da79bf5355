// What sanitizers are told, in every program that is built with them. Suppressed is third-party code alone,
// by name.

extern "C" {

const char* __asan_default_options() {
    return "detect_stack_use_after_return=1"
           ":alloc_dealloc_mismatch=0"  // Triad's own `delete` (base/memory_limit.h) frees what their `new`
                                        // gave
           ":allocator_may_return_null=1";  // what is too large is a std::bad_alloc, which has its sentence
}

const char* __ubsan_default_options() { return "halt_on_error=1:print_stacktrace=1"; }

const char* __lsan_default_options() { return "print_suppressions=0"; }

const char* __lsan_default_suppressions() {
    return "leak:libpocl\n"
           "leak:libLLVM\n";
}

const char* __tsan_default_suppressions() {
    return "called_from_lib:libpocl\n"
           "called_from_lib:libLLVM\n";
}
}

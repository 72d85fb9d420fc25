// The one translation unit that holds Catch2's main: compiled once for all test programs.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>

#ifdef __SANITIZE_ADDRESS__
/// The leak sanitizer reads it at the end: gmsh and OpenCASCADE (libTK*) keep geometry until the process ends.
extern "C" __attribute__((visibility("default"))) const char* __lsan_default_suppressions();
const char* __lsan_default_suppressions() { return "leak:libgmsh\nleak:libTK\n"; }
/// A C library handles a refused allocation itself, so that it returns null, as without the sanitizer.
extern "C" __attribute__((visibility("default"))) const char* __asan_default_options();
// gmsh frees memory of new[] with delete when it describes wedges of order 2.
const char* __asan_default_options() { return "allocator_may_return_null=1:alloc_dealloc_mismatch=0"; }
#endif

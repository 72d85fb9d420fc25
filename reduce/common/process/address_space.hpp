// What a process takes of its address space, which a user may limit (ulimit -v).
#pragma once

#include <sys/resource.h>

namespace bielle {

/// OpenBLAS takes so much for each of its threads [bytes], and tries for ever where it does not get it.
inline constexpr rlim_t blas_buffer = rlim_t{136} << 20;

/// Of this process, with what is loaded [bytes]; 0 when it is not known. Nothing that could allocate is called, and no
/// sanitizer needed: it may be asked before the libraries begin.
rlim_t address_space();

}  // namespace bielle

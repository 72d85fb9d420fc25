// The address space of a process, which a user may limit (ulimit -v).
#pragma once

#include <sys/resource.h>

namespace bielle {

/// OpenBLAS allocates this buffer for each of its threads [bytes]; it retries forever if the allocation fails.
inline constexpr rlim_t blas_buffer = rlim_t{136} << 20;

/// Address space of this process including loaded libraries [bytes]; 0 if it is unknown. It neither allocates nor needs
/// a sanitizer's runtime, and may therefore be called before the libraries are initialised.
rlim_t address_space();

}  // namespace bielle

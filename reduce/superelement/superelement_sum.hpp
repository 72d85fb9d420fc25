// A checksum that tells whether the numbers of a superelement are those that were written.
#pragma once

#include <cstdint>

namespace bielle {

struct Superelement;

/// Returns a checksum over all numbers and names of interfaces, loads, points, mesh, matrices and recovery.
std::int64_t sum_of(const Superelement& body);

}  // namespace bielle

// A model held by Python: shared by the sessions, motions and results that refer to it.
#pragma once

#include <memory>

#include "mechanism/io/mechanism_file.hpp"

namespace bielle::python {

using HeldModel = std::shared_ptr<const mechanism::MechanismFile>;

}  // namespace bielle::python

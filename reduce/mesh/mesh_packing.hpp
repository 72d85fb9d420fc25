// Packing of a mesh and of the phases of its import, to send them from one process to another.
#pragma once

#include "reduce/common/files/packing.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/mesh/mesh.hpp"

namespace bielle {

inline void exchange(Packing& packing, PhaseReport& phase) {
  packing(phase.name);
  packing(phase.seconds);
  packing(phase.peak_memory_MB);
}

}  // namespace bielle

namespace bielle::reduce {

inline void exchange(Packing& packing, CellBlock& block) {
  packing(block.type);
  packing(block.nodes);
}

inline void exchange(Packing& packing, GroupPart& part) {
  packing(part.type);
  packing(part.cells);
}

inline void exchange(Packing& packing, Group& group) {
  packing(group.dimension);
  packing(group.parts);
  packing(group.nodes);
  packing(group.weights);
}

inline void exchange(Packing& packing, Mesh& mesh) {
  packing(mesh.points);
  packing(mesh.blocks);
  packing(mesh.groups);
}

}  // namespace bielle::reduce

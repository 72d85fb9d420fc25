#include "reduce/distributed/shares.hpp"

#include "reduce/mesh/mesh_packing.hpp"

namespace bielle::reduce {

void exchange(Packing& packing, Material& material) {
  packing(material.elasticity);
  packing(material.density);
  packing(material.winding_point);
  packing(material.winding_axis);
}

void exchange(Packing& packing, Coating& coating) {
  packing(coating.faces);
  packing(coating.mass_per_area);
}

void exchange(Packing& packing, MeshShare& share) {
  packing(share.points);
  packing(share.blocks);
  packing(share.material_of);
  packing(share.materials);
  packing(share.integration);
  packing(share.coatings);
  packing(share.lumped);
}

void exchange(Packing& packing, InteriorShare& share) {
  packing(share.numbers);
  packing(share.starts);
  packing(share.unknowns);
  packing(share.weights);
}

void exchange(Packing& packing, BlockStarts& blocks) { packing(blocks.starts); }

}  // namespace bielle::reduce

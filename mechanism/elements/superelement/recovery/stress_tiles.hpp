// Computes the stress of all nodes at several frames, node by node, without storing it.
#pragma once

#include <algorithm>
#include <array>

#include "mechanism/elements/superelement/recovery/stress_recovery.hpp"

namespace bielle::mechanism {

/// Calls act(row, frame, stress (6)) for every node and frame. Nodes are divided among threads; the frames of a node
/// are processed in their order, all in one thread.
template <class Act>
void for_each_stress(const StressRecovery& stress, const FrameBlock& coordinates, Act&& act) {
  constexpr int tile = 16;  // number of nodes whose part of the matrix stays in the cache for all frames
  const int nodes = stress.size();
  const int threads = recovery_threads(stress.matrix.rows(), stress.matrix.cols(), coordinates.frames());
#pragma omp parallel for num_threads(threads) schedule(static)
  for (int begin = 0; begin < nodes; begin += tile) {
    alignas(64) std::array<double, 6 * tile * frames_abreast> values;
    const int count = std::min(tile, nodes - begin);
    for (int g = 0; g < coordinates.groups(); ++g) {
      multiply_rows(stress.matrix, 6 * begin, 6 * count, coordinates.group(g), values.data());
      const int first = g * frames_abreast, last = std::min(first + frames_abreast, coordinates.frames());
      for (int frame = first; frame < last; ++frame)
        for (int k = 0; k < count; ++k) {
          std::array<double, 6> s;
          for (int i = 0; i < 6; ++i)
            s[static_cast<std::size_t>(i)] =
                values[static_cast<std::size_t>(frames_abreast * (6 * k + i) + frame - first)];
          act(begin + k, frame, s.data());
        }
    }
  }
}

}  // namespace bielle::mechanism

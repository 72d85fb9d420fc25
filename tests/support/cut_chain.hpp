// A cut body for tests, without a mesh: the straight beam of beam_superelement.hpp in three pieces.
#pragma once

#include "reduce/superelement/assembled_pieces.hpp"
#include "reduce/superelement/cut_body.hpp"
#include "tests/support/beam_superelement.hpp"

namespace bielle::test {

/// Returns the part of the beam between two places of its axis.
inline Superelement beam_part(double from, double to, const std::string& start, const std::string& end,
                              const BeamLoad& load = {}) {
  BeamChain chain;
  for (int k = 0; k <= 8; ++k) chain.nodes.push_back({from + (to - from) * k / 8, 0, 0});
  BeamInterface a, b;
  b.node = 8;
  chain.interfaces = {a, b};
  chain.modes = 3;
  if (!load.pattern.empty()) chain.loads = {load};
  Superelement part = chain.reduced().body;
  part.interfaces[0].name = start;
  part.interfaces[1].name = end;
  return part;
}

/// Interfaces "root" at 0 and "tip" at 1, cut at 0.3 and 0.6; the pattern "wind" acts on pieces 2 and 3.
inline CutBody cut_beam() {
  CutBody body;
  body.name = "beam";
  body.created_by = "test";
  body.input = "body: beam\n";
  const BeamLoad wind{"wind", 4, {0, 1, 0}};
  body.pieces = {beam_part(0, 0.3, "root", "cut_1"), beam_part(0.3, 0.6, "cut_1", "cut_2", wind),
                 beam_part(0.6, 1, "cut_2", "tip", wind)};
  for (std::size_t k = 0; k < body.pieces.size(); ++k) body.pieces[k].name = "beam." + std::to_string(k + 1);
  body.cuts = {{"cut_1", {0, 1}, {0.3, 0, 0}, 0.01, 0}, {"cut_2", {1, 2}, {0.6, 0, 0}, 0.01, 1e-3}};
  body.free_frequencies = Eigen::Vector2d(3, 4);
  body.effect = {Eigen::Vector2d(2.9, 4), {1.001, 1.02}};
  return body;
}

}  // namespace bielle::test

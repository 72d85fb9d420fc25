#include "reduce/spectral/fill_reducing_order.hpp"

#include <cholmod.h>
#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle {

namespace {

constexpr int small_graph = 200;  // blocks below which minimum degree orders as well as nested dissection

/// CHOLMOD's settings and workspace; one per thread.
class Common {
 public:
  Common() {
    cholmod_start(&common_);
    common_.print = 0;
  }
  ~Common() { cholmod_finish(&common_); }
  Common(const Common&) = delete;
  Common& operator=(const Common&) = delete;
  operator cholmod_common*() { return &common_; }

  /// @throws ComputationError when the last call failed
  void check() const {
    if (common_.status == CHOLMOD_OUT_OF_MEMORY || common_.status == CHOLMOD_TOO_LARGE)
      throw ComputationError("not enough memory for the ordering of the stiffness matrix; a coarser mesh needs less");
    if (common_.status < 0)
      throw ComputationError(fmt::format("CHOLMOD failed in the ordering of a matrix (status {})", common_.status));
  }

 private:
  cholmod_common common_;
};

/// A view for CHOLMOD, which does not change it.
cholmod_sparse view(const BlockGraph& graph) {
  cholmod_sparse a{};
  a.nrow = a.ncol = static_cast<std::size_t>(graph.size());
  a.nzmax = graph.rows.size();
  a.p = const_cast<int*>(graph.starts.data());
  a.i = const_cast<int*>(graph.rows.data());
  a.stype = -1;
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_PATTERN;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = 1;
  a.packed = 1;
  return a;
}

}  // namespace

std::vector<int> fill_reducing_order(const BlockGraph& graph) {
  Common common;
  cholmod_sparse pattern = view(graph);
  std::vector<int> order(static_cast<std::size_t>(graph.size()));
  if (graph.size() < small_graph) {
    cholmod_amd(&pattern, nullptr, 0, order.data(), common);
  } else {
    cholmod_metis(&pattern, nullptr, 0, 1, order.data(), common);
  }
  common.check();
  return order;
}

}  // namespace bielle

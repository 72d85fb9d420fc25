// Activity of entries: whether the components that an entry is read into are in the equations.
//
// An entry that is released adds nothing: no forces, no energy, no derivatives; its constraints are switched off and
// its multipliers are zero. Its memory stays, so that it can be activated again (Component::activate). The components
// themselves know nothing of this: whoever evaluates them asks `Activities` first.
#pragma once

#include <cstddef>
#include <vector>

#include "mechanism/model/component.hpp"
#include "mechanism/model/entry.hpp"
#include "mechanism/model/model.hpp"

namespace bielle::mechanism {

/// Activity of one entry, in its memory: [1 active, 0 released]. It governs all components that are created from the
/// entry or act in it (the springs, locks and drives of a joint), and belongs to the entry itself.
class Activity final : public Component {
 public:
  /// @param starts_active  whether the entry is active at the start of the first analysis
  Activity(const Entry& entry, bool starts_active)
      : Component("activity", entry.name), entry_(entry), starts_active_(starts_active) {}
  const Entry& entry() const { return entry_; }
  bool starts_active() const { return starts_active_; }
  /// @param state  state of this component
  static bool is_active(const LocalState& state) { return state.memory()[0] != 0; }

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState&, Eigen::Ref<VectorX>) const override {}
  void describe(const LocalState& state, Description& description) const override;
  bool knows_memory(const LocalState& state) const override;

 private:
  Entry entry_;
  bool starts_active_;
};

/// Returns the activity of an entry, or nullptr if it is always active.
const Activity* find_activity(const Model& model, const Entry& entry);
/// Returns the activity of an entry; it is added if the entry has none.
/// @pre the components of the entry have been added
const Activity& activity_of(Model& model, const Entry& entry, bool starts_active = true);

/// Returns the activities that govern a component.
std::vector<const Activity*> activities_of(const Model& model, const Component& component);

/// The members of a model that are governed by activities.
class Activities {
 public:
  explicit Activities(const Model& model);
  bool any() const { return !begin_.empty(); }
  bool is_governed(std::size_t member) const { return any() && begin_[member] < begin_[member + 1]; }
  /// Returns whether a member is in the equations at a state. A member that several activities govern (a drive: its own
  /// and that of its joint) is active if all of them are.
  bool is_active(const VectorX& memory, const std::vector<Slots>& slots, std::size_t member) const {
    if (!any()) return true;
    for (std::size_t k = begin_[member]; k < begin_[member + 1]; ++k)
      if (memory[slots[governor_[k]].memory_begin] == 0) return false;
    return true;
  }
  bool is_active(const State& state, const std::vector<Slots>& slots, std::size_t member) const {
    return is_active(state.memory, slots, member);
  }

 private:
  std::vector<std::size_t> begin_;     ///< first governor of each member, and the end; empty: there are no activities
  std::vector<std::size_t> governor_;  ///< members that are activities
};

/// Returns whether values in these units are those of forces, or follow from them (stresses, powers, energies), or of
/// flows: a released entry has none.
bool are_units_of_forces(const std::string& units);

}  // namespace bielle::mechanism

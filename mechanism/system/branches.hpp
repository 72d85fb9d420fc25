// Branches of a motion: the events that end them, and the memory that components carry from one to the next.
#pragma once

#include <string>
#include <vector>

#include "mechanism/system/shared_work.hpp"

namespace bielle::mechanism {

/// An event function that a member declares, see Component::calc_event_functions.
struct MemberEventFunction {
  std::size_t member;
  int index;  ///< index among the member's own event functions
  EventFunction function;
  std::string name;  ///< name with its owner: "joint 'door': angle at its upper stop"
};

class Branches {
 public:
  /// The object keeps references to its arguments.
  Branches(const Model& model, const Unknowns& unknowns, const SharedWork& work)
      : model_(model), unknowns_(unknowns), work_(work) {}
  Branches(const Branches&) = delete;
  Branches& operator=(const Branches&) = delete;

  /// Adds the event functions and memory that the next member of the model declares.
  void add(const Declaration& declaration);

  const std::vector<MemberEventFunction>& event_functions() const {
    return event_functions_;
  }  ///< in the order of the members
  bool reads_reactions() const { return reads_reactions_; }
  bool has_kinks() const { return kinks_; }
  bool event_functions_read_reactions() const { return event_functions_read_reactions_; }

  // See the functions of the same names in System.
  void calc_event_functions(const State& state, const Environment& environment, Eigen::Ref<VectorX> values) const;
  double calc_event_function(const State& state, const Environment& environment, int event_function) const;
  /// Does the actions of the events that occurred, then lets components begin their branch. Those that are activated
  /// do so before.
  void begin(State& state, const Environment& environment, const std::vector<int>& crossed) const;
  void begin_motion(State& state, const Environment& environment, bool known) const;
  /// Components update their memory. @returns whether a component has left its branch
  bool accept(State& state, const Environment& environment) const;
  void accept_activated(State& state, const Environment& environment, const VectorX& before) const;

 private:
  void do_actions(State& state, const Environment& environment, const std::vector<int>& ascending) const;
  /// @param before  memory before the actions
  template <class Act>
  void for_each_activated(State& state, const Environment& environment, const VectorX& before, const Act& act) const;
  LocalState local(const State& state, std::size_t member, const Environment& environment) const {
    return {state, unknowns_.slots()[member], environment};
  }

  const Model& model_;
  const Unknowns& unknowns_;
  const SharedWork& work_;
  std::size_t members_ = 0;
  std::vector<std::size_t> remembering_;  ///< members with memory
  std::vector<MemberEventFunction> event_functions_;
  bool reads_reactions_ = false, kinks_ = false, event_functions_read_reactions_ = false;
};

}  // namespace bielle::mechanism

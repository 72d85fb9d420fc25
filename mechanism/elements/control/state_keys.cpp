// Keys of the section `states` of the mechanism file.
#include "mechanism/elements/control/delay_reader.hpp"
#include "mechanism/elements/control/sampled_reader.hpp"
#include "mechanism/elements/control/state_reader.hpp"

namespace bielle::mechanism {
namespace {

KeyForm input() { return keys::state_formula("any", {"t"}); }

Key rate_key() {
  return {"rate", input(), keys::required, "Rate of the state as a formula of the time t, parameters and measures."};
}

Key filter_key() { return {"filter", input(), keys::required, "Formula that is filtered."}; }

const KeyTable& transfer_function_keys() {
  using namespace keys;
  static const KeyTable table{
      "`transfer_function`",
      "A transfer function as a quotient of two polynomials in s, of a sampled block in z.",
      {{"numerator", list_of(number()), required,
        "Coefficients in descending powers of s or z, of at most the degree of the denominator."},
       {"denominator", list_of(number()), required, "Coefficients in descending powers of s or z."}}};
  return table;
}

}  // namespace

Key transfer_function_key() {
  return {"transfer_function", keys::nested(transfer_function_keys), keys::required,
          "Numerator and denominator of the transfer function."};
}

namespace {

const KeyTable& matrices_keys() {
  using namespace keys;
  const KeyForm rows = list_of(list_of(number()));
  static const KeyTable table{"`state_space`",
                              "Matrices of x' = A x + B u, y = C x + D u, by rows; of a sampled block, A and B lead "
                              "from the state x of one instant to that of the next.",
                              {{"A", rows, required, "Square matrix of the states."},
                               {"B", rows, required, "Matrix of the inputs."},
                               {"C", rows, computed("the identity"), "Matrix of the outputs."},
                               {"D", rows, computed("zero"), "Direct feed-through of the inputs."}}};
  return table;
}

}  // namespace

Key state_space_key() { return {"state_space", keys::nested(matrices_keys), keys::required, "Matrices of the block."}; }

namespace {

/// Returns the keys of one kind of state, followed by those that all kinds have.
/// @param units  default of the recorded units
std::vector<Key> with_common_keys(std::vector<Key> own, Presence units) {
  using namespace keys;
  return joined({std::move(own),
                 {{"units", {text(), list_of(text())}, std::move(units), "Recorded units; a list for several outputs."},
                  {"scale", number("any").positive(), computed("1, or the value at the start if that is larger"),
                   "Typical size of the state in its units, to which accuracies of Newton's method and of adaptive "
                   "steps are relative."}}});
}

const KeyTable& rate_keys() {
  using namespace keys;
  static const KeyTable table{
      "a state with a `rate`", "A differential equation of first order.",
      with_common_keys({rate_key(), {"start", number("any"), otherwise("0"), "Value at the start."}},
                       otherwise("'-'"))};
  return table;
}

const KeyTable& filter_keys() {
  using namespace keys;
  static const KeyTable table{
      "a filter", "A low-pass filter of first or second order.",
      with_common_keys(
          {filter_key(),
           {"time_constant", number("s").non_negative(), optional,
            "Time constant of a filter of first order; with 0 the state is the input itself."},
           {"frequency", number("Hz").positive(), optional,
            "Frequency of a filter of second order, in place of `time_constant`."},
           {"damping", number().non_negative(), otherwise("sqrt(0.5)"), "Damping ratio of a filter of second order."},
           {"start",
            {word({"equilibrium"}, "a start of a filter"), number("any")},
            otherwise("equilibrium"),
            "Value at the start, or `equilibrium`: the value of the input at the start, without a transient."}},
          computed("those of the input"))};
  return table;
}

const KeyTable& transfer_keys() {
  using namespace keys;
  static const KeyTable table{
      "a transfer function", "A control block by its transfer function.",
      with_common_keys({transfer_function_key(),
                        {"input", input(), required, "Formula of the input."},
                        {"start", word({"zero", "equilibrium"}, "a start of a transfer function"), otherwise("zero"),
                         "State at the start: as if the input had been zero before, or as if it had always been what "
                         "it is at the start."}},
                       otherwise("'-'"))};
  return table;
}

const KeyTable& state_space_keys() {
  using namespace keys;
  static const KeyTable table{
      "a state-space block", "A control block by the matrices of its state space.",
      with_common_keys({state_space_key(),
                        {"inputs", list_of(input()).items_at_least(1), required, "Formulas of the inputs."},
                        {"start",
                         {list_of(number("any")), word({"equilibrium"}, "a start of a state-space block")},
                         computed("zeros"),
                         "Values of the states at the start, or `equilibrium`."}},
                       otherwise("'-'"))};
  return table;
}

}  // namespace

const KeyTable& state_keys() {
  using namespace keys;
  static const KeyTable table{
      "a state",
      "An unknown of first order: a differential equation or a control block.",
      [] {
        std::vector<Key> kinds = {rate_key(), filter_key(), transfer_function_key(), state_space_key()};
        for (Key& kind : kinds) kind.presence = optional;
        for (Key kind : {sampled_key(), delay_key()}) {
          kind.presence = optional;
          kinds.push_back(std::move(kind));
        }
        kinds.push_back({"start", {number("any"), text()}, optional, "Value at the start."});
        return with_common_keys(std::move(kinds), optional);
      }(),
      // A block that has a `period` is sampled, also if it lacks its `sampled` formula.
      {{"sampled", "", sampled_keys},
       {"period", "", sampled_keys},
       {"delayed", "", delay_keys},
       {"rate", "", rate_keys},
       {"filter", "", filter_keys},
       {"transfer_function", "", transfer_keys},
       {"state_space", "", state_space_keys}}};
  return table;
}

}  // namespace bielle::mechanism

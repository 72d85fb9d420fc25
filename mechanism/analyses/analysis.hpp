// An analysis: what a session is to do, with what it records and says.
//
// A new one is a class of this kind in a file of its own, with the reader of its keys, and a line in
// analysis_table.cpp. Reading, running, the results file and the summary take it from there.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/session/session.hpp"

namespace bielle::mechanism {

struct AnalysisSummary {
  std::string text;  ///< what the program says of it: a heading, and lines below it
  long records = 0;  ///< rows
  /// Results in numbers, by name: "limit_points".
  std::map<std::string, std::vector<double>> numbers;
};

class Analysis {
 public:
  /// @param type  as in the input file: "dynamic"
  explicit Analysis(std::string type) : type_(std::move(type)) {}
  virtual ~Analysis() = default;
  Analysis(const Analysis&) = delete;
  Analysis& operator=(const Analysis&) = delete;

  const std::string& type() const { return type_; }
  /// Does it, from where the session stands. Rows and arrays go to the session's sinks.
  /// @throws InputError, ComputationError
  AnalysisSummary run(Session& session) const;
  /// Goes on with it from what a sink keeps, whose rows of it are there. @throws InputError when it cannot
  AnalysisSummary go_on(Session& session, const std::vector<double>& checkpoint, ResultSink& sink) const;

  /// How the model that it will run on is made anew with another parameter, for those that sweep one.
  virtual void set_maker(const ModelMaker& /*maker*/) {}

  virtual bool can_go_on() const { return false; }  ///< whether sinks get points to go on from
  /// What it keeps as drawn while it brings parts together, for `--check`.
  virtual AssemblyOptions kept() const { return {}; }
  virtual double duration() const { return 0; }  ///< by which time goes on [s]
  /// How many rows will be recorded; 0: unknown, or none.
  virtual std::size_t expected_rows(const Recording& /*recording*/) const { return 0; }

 private:
  virtual void solve(Session& session, AnalysisSummary& summary) const = 0;
  virtual void solve_rest(Session& session, const std::vector<double>& checkpoint, ResultSink& sink,
                          AnalysisSummary& summary) const;
  std::string type_;
};

}  // namespace bielle::mechanism

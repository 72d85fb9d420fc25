// Combines several step recorders of one component into one.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/model/step_recorder.hpp"

namespace bielle::mechanism {

class StepRecorderList final : public StepRecorder {
 public:
  explicit StepRecorderList(std::vector<std::unique_ptr<StepRecorder>> all) : all_(std::move(all)) {}

  void begin() override {
    for (const auto& each : all_) each->begin();
  }
  void add(const LocalState& state) override {
    for (const auto& each : all_) each->add(state);
  }
  void exchange(Archive& archive) override {
    for (const auto& each : all_) each->exchange(archive);
  }
  std::vector<ResultArray> results() override {
    std::vector<ResultArray> all;
    for (const auto& each : all_)
      for (ResultArray& array : each->results()) all.push_back(std::move(array));
    return all;
  }
  std::vector<std::string> datasets() override {
    std::vector<std::string> all;
    for (const auto& each : all_)
      for (std::string& name : each->datasets()) all.push_back(std::move(name));
    return all;
  }
  std::string summary() override {
    std::string text;
    for (const auto& each : all_) text += each->summary();
    return text;
  }
  std::string what() const override {
    std::string text;
    for (const auto& each : all_) text += (text.empty() ? "" : ", ") + each->what();
    return text;
  }

 private:
  std::vector<std::unique_ptr<StepRecorder>> all_;
};

}  // namespace bielle::mechanism

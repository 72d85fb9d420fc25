// Law 5: a value outside its range, of the wrong kind, or missing is refused with file, line and key; so is an unknown
// key.
#include <catch2/catch.hpp>
#include <yaml-cpp/yaml.h>

#include "reduce/common/error.hpp"
#include "tests/laws/subject.hpp"
#include "tests/support/messages.hpp"

using namespace bielle::laws;
using Catch::Contains;

namespace {

/// The sample's model with one value of `it` changed; an empty value leaves the key out.
std::string changed(const Sample& sample, const std::string& key, const std::string& value) {
  YAML::Node root = YAML::Load(sample.model);
  YAML::Node entry = root[bielle::mechanism::section_name(sample.section)]["it"];
  std::string last = key;
  for (std::size_t dot; (dot = last.find('.')) != std::string::npos; last = last.substr(dot + 1))
    entry.reset(entry[last.substr(0, dot)]);
  if (value.empty())
    entry.remove(last);
  else
    entry[last] = YAML::Load(value);
  YAML::Emitter out;
  out << root;
  return out.c_str();
}

std::string message(const Sample& sample, const std::string& text) {
  return bielle::test::message_of<bielle::InputError>([&] { read_sample(sample, text); });
}

std::vector<std::string> keys_of(const Sample& sample) {
  std::vector<std::string> keys;
  for (const auto& item : YAML::Load(sample.model)[bielle::mechanism::section_name(sample.section)]["it"])
    keys.push_back(item.first.as<std::string>());
  return keys;
}

}  // namespace

TEST_CASE("law 5: values out of range are refused with their key") {
  for (const Sample& sample : samples()) {
    const std::string place = std::string(bielle::mechanism::section_name(sample.section)) + ".it";
    for (const BadValue& bad : sample.bad) {
      CAPTURE(title(sample), bad.key, bad.value);
      const std::string said = message(sample, changed(sample, bad.key, bad.value));
      CHECK_THAT(said, Contains("model.yaml:") && Contains(place));
      CHECK_THAT(said, Contains(bad.key.substr(bad.key.rfind('.') + 1)));
      CHECK_THAT(said, Contains(bad.says));
    }
    for (const std::string& key : keys_of(sample)) {
      CAPTURE(title(sample), key);
      const auto concerns = [&](const BadValue& b) { return b.key == key || b.key.rfind(key + ".", 0) == 0; };
      const bool covered = key == "type" || std::any_of(sample.bad.begin(), sample.bad.end(), concerns);
      CHECK(covered);  // each key that a sample shows has a bad value
      // The wrong kind of value altogether.
      CHECK_THAT(message(sample, changed(sample, key, "{nonsense: 1}")),
                 Contains("model.yaml:") && Contains(place) && Contains(key));
    }
    CAPTURE(title(sample));
    CHECK_THAT(message(sample, changed(sample, "nonsense", "1")), Contains("model.yaml:") && Contains("nonsense"));
  }
}

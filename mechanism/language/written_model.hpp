// A model that is being written out: its sections, with the entries that are known so far.
#pragma once

#include <map>
#include <string>
#include <unordered_set>
#include <vector>

#include "mechanism/language/tree.hpp"
#include "mechanism/math/se3.hpp"
#include "reduce/common/formula/expression.hpp"

namespace bielle::mechanism {

class WrittenModel {
 public:
  /// @param parameters  parameters of the model, which outlive this
  WrittenModel(std::string main_file, const Parameters& parameters);

  /// Adds an entry. @throws InputError if the section has one of this name
  void add(const std::string& section, const std::string& name, Tree value);
  /// Adds an entry to a list within the section `hydraulics`.
  void add_hydraulic(const std::string& list, const std::string& name, Tree value);
  /// Sets a key of the section `hydraulics` that has no entries, such as its fluid. @throws InputError if it is set
  void set_hydraulic(const YamlNode::Pair& pair, Tree value);
  /// Adds a node at a point of a body and returns its name. @param point  a map of body_point_keys
  std::string add_point(const YamlNode& point, const std::string& path);
  /// Notes that a rigid body carries a node. @param body  its name in the file
  void carry(const std::string& node, const YamlNode& body, const std::string& path);

  /// Returns the frame of a node. @param place  the node's name in the file
  Frame frame_of_node(const std::string& name, const YamlNode& place, const std::string& path) const;
  /// Reads the position and orientation of a node. @param entry  in the model
  Frame frame_of_entry(const Tree& entry, const std::string& path) const;

  /// Returns the file: sections of `root` in their order, those that only parts have behind them.
  Tree finish(const YamlNode& root);

 private:
  struct Section {
    Pairs pairs;
    std::map<std::string, std::size_t> places;
  };
  /// A node that a body carries.
  struct Carried {
    std::string body, node;
    Tree place;           ///< the body's name in the file, or the point of the body
    bool is_new = false;  ///< whether the node has to be made, at the point
    std::string path;
  };
  void append(Section& section, const std::string& name, Tree value, const std::string& path) const;
  Tree node(const std::string& name, const YamlNode& place, const std::string& path) const;
  /// Reads the place of a node in the axes of the node that it names.
  Frame own_frame(const YamlNode& entry) const;
  /// Returns the entry of the node at a point of a body, which is known.
  Tree node_of_point(const Carried& point, const YamlNode& body) const;
  void carry_nodes();
  void check_carrier(const Carried& carried, const YamlNode& body) const;
  std::vector<std::string> names_in(const std::string& section) const;

  std::string main_file_;
  const Parameters& parameters_;
  std::map<std::string, Section> sections_;
  std::map<std::string, Section> hydraulic_lists_;
  std::vector<Carried> carried_;
  std::map<std::string, std::size_t> points_;    ///< places of the new nodes among them
  mutable std::map<std::string, Frame> frames_;  ///< frames of nodes whose place has been asked for
};

}  // namespace bielle::mechanism

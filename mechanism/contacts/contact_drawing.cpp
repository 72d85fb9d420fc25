// The shapes of a contact as they are drawn.
#include <memory>

#include "mechanism/contacts/contact.hpp"
#include "mechanism/drawing/drawing.hpp"

namespace bielle::mechanism {
namespace {

std::shared_ptr<const DrawnMesh> drawn_surface(const TriangleSurface& surface) {
  auto mesh = std::make_shared<DrawnMesh>();
  mesh->name = "surface";
  for (const Vector3& p : surface.points()) {
    const Eigen::Vector3f point = p.cast<float>();
    mesh->points.push_back({point[0], point[1], point[2]});
  }
  for (const TriangleSurface::Triangle& t : surface.triangles()) mesh->triangles.push_back({t[0], t[1], t[2]});
  return mesh;
}

void draw_contact_shape(const ContactShape& shape, Drawing& drawing) {
  using Kind = ContactShape::Kind;
  const auto add = [&](const char* kind, const Frame& frame, std::vector<std::pair<std::string, DrawnValue>> values) {
    DrawnItem item{.shape = kind, .places = {{shape.node, frame}}, .values = std::move(values), .role = "contact"};
    if (shape.kind == Kind::surface) item.mesh = drawn_surface(*shape.surface);
    drawing.add(std::move(item));
  };
  switch (shape.kind) {
    case Kind::sphere:
      return add("sphere", shape.frame, {{"radius", shape.radius}});
    case Kind::plane:
      return add("plane", shape.frame, {});
    case Kind::cylinder:
      return add("cylinder", shape.frame, {{"radius", shape.radius}, {"length", 2 * shape.half_length}});
    case Kind::box:
      return add("box", shape.frame, {{"size", numbers_of(2 * shape.half)}});
    case Kind::surface:
      return add("mesh", shape.frame, {});
    case Kind::capsule:
      add("cylinder", shape.frame, {{"radius", shape.radius}, {"length", 2 * shape.half_length}});
      for (const double end : {-1.0, 1.0})
        add("sphere", shape.frame * Frame{{0, 0, end * shape.half_length}, Matrix3::Identity()},
            {{"radius", shape.radius}});
  }
}

}  // namespace

void Contact::draw(Drawing& drawing) const {
  for (const ContactShape& shape : shapes_) draw_contact_shape(shape, drawing);
}

}  // namespace bielle::mechanism

#include "common/body_model/content_hash.h"

#include <cstring>

namespace deixis::body_model {
namespace {

class Hash {
 public:
  void Add(std::uint64_t bits) {
    for (int byte = 0; byte < 8; ++byte) AddByte(static_cast<std::uint8_t>(bits >> (8 * byte)));
  }
  void Add(double value) {
    std::uint64_t bits = 0;
    value += 0.0;  // Minus zero is zero.
    std::memcpy(&bits, &value, sizeof bits);
    Add(bits);
  }
  void Add(const std::string& text) {
    Add(static_cast<std::uint64_t>(text.size()));
    for (const char letter : text) AddByte(static_cast<std::uint8_t>(letter));
  }
  template <typename Vector>
  void AddAll(const Vector& values) {
    for (Eigen::Index i = 0; i < values.size(); ++i) Add(double{values[i]});
  }
  std::int64_t value() const { return static_cast<std::int64_t>(state_ == 0 ? 1 : state_); }

 private:
  void AddByte(std::uint8_t byte) { state_ = (state_ ^ byte) * 0x100000001b3ULL; }

  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

void AddShape(const geometry::DegenerateCylinder& shape, Hash& hash) {
  for (const double size_m : {shape.a0_m, shape.b0_m, shape.a1_m, shape.b1_m, shape.length_m}) {
    hash.Add(size_m);
  }
  hash.AddAll(shape.centre0_m);
  hash.AddAll(shape.centre1_m);
}

void AddDof(const DegreeOfFreedom& dof, Hash& hash) {
  hash.Add(dof.name);
  hash.Add(static_cast<std::uint64_t>(dof.kind));
  hash.AddAll(dof.axis);
  for (const double value : {dof.angle_min_rad, dof.angle_max_rad, dof.speed_max_rad_per_s,
                             dof.acceleration_max_rad_per_s2}) {
    hash.Add(value);
  }
}

}  // namespace

std::int64_t ContentHash(const std::string& name, const std::vector<Limb>& limbs) {
  Hash hash;
  hash.Add(name);
  hash.Add(static_cast<std::uint64_t>(limbs.size()));
  for (const Limb& limb : limbs) {
    hash.Add(limb.name);
    hash.Add(static_cast<std::uint64_t>(static_cast<std::int64_t>(limb.parent)));
    const Eigen::Quaterniond& rotation = limb.rest_in_parent.rotation;
    for (const double part : {rotation.w(), rotation.x(), rotation.y(), rotation.z()}) {
      hash.Add(part);
    }
    hash.AddAll(limb.rest_in_parent.translation_m);
    AddShape(limb.shape, hash);
    hash.Add(static_cast<std::uint64_t>(limb.dofs.size()));
    for (const DegreeOfFreedom& dof : limb.dofs) AddDof(dof, hash);
  }
  return hash.value();
}

}  // namespace deixis::body_model

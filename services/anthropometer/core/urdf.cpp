#include "services/anthropometer/core/urdf.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "common/config/config.h"
#include "services/anthropometer/core/solid.h"

namespace deixis::anthropometer {
namespace {

using body_model::BodyModel;
using body_model::Limb;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A limb's name without its side, and the side as REP 155 writes it: "l_", "r_" or nothing.
struct Sided {
  std::string side, limb;
};

Sided Split(const std::string& name) {
  if (name.rfind("right_", 0) == 0) return {"r_", name.substr(6)};
  if (name.rfind("left_", 0) == 0) return {"l_", name.substr(5)};
  return {"", name};
}

/// REP 155's name of a limb's link; what it does not know keeps its name.
std::string LinkStem(const std::string& limb) {
  static const std::map<std::string, std::string> kStems = {
      {"pelvis", "waist"}, {"chest", "torso"}, {"upper_arm", "shoulder"}, {"lower_arm", "elbow"},
      {"hand", "wrist"},   {"thigh", "hip"},   {"shank", "knee"},         {"foot", "ankle"}};
  const auto found = kStems.find(limb);
  return found == kStems.end() ? limb : found->second;
}

/// The letter of a joint among those of one limb, as REP 155 has them: y(aw), p(itch), r(oll).
/// Those of shoulder and hip are named there by the axes of the hanging limb.
char LetterOf(const std::string& stem, const std::string& dof) {
  static const std::map<std::string, char> kUsual = {
      {"flexion", 'p'},   {"lateral_flexion", 'r'},  {"rotation", 'y'},        {"pronation", 'y'},
      {"inversion", 'y'}, {"elevation", 'r'},        {"protraction", 'y'},     {"abduction", 'r'},
      {"adduction", 'r'}, {"radial_abduction", 'r'}, {"dorsal_extension", 'p'}};
  static const std::map<std::string, std::map<std::string, char>> kOwn = {
      {"shoulder", {{"horizontal_flexion", 'y'}, {"abduction", 'p'}, {"rotation", 'r'}}},
      {"hip", {{"flexion", 'r'}, {"abduction", 'p'}, {"rotation", 'y'}}}};
  const auto own = kOwn.find(stem);
  const auto& letters = own == kOwn.end() ? kUsual : own->second;
  const auto found = letters.find(dof);
  return found == letters.end() ? '?' : found->second;
}

/// A letter for each joint of the chain, no two alike.
std::string LettersOf(const Limb& limb, const std::string& stem,
                      const std::vector<ChainJoint>& chain) {
  std::string letters;
  for (const ChainJoint& joint : chain) {
    char letter = '?';
    if (joint.dof >= 0)
      letter = LetterOf(stem, limb.dofs[static_cast<std::size_t>(joint.dof)].name);
    letters += letters.find(letter) == std::string::npos ? letter : '?';
  }
  for (char& letter : letters) {
    for (const char free : {'p', 'r', 'y'}) {
      if (letter == '?' && letters.find(free) == std::string::npos) letter = free;
    }
  }
  return letters;
}

std::string LinkOf(const Limb& limb, const std::string& body_id) {
  const Sided name = Split(limb.name);
  return name.side + LinkStem(name.limb) + "_" + body_id;
}

/// The joints between a limb's parent and the limb. A hinge bears the limb's name alone, as elbow
/// and knee do in REP 155.
void AppendChain(const Limb& limb, int index, const std::string& parent, const std::string& body_id,
                 std::vector<UrdfJoint>& joints) {
  const Sided name = Split(limb.name);
  const std::string stem = LinkStem(name.limb), link = LinkOf(limb, body_id);
  const auto chain = ChainOf(limb);
  if (chain.empty()) {
    joints.push_back({link, parent, link, index, limb.rest_in_parent, true, {}});
    return;
  }
  const std::string letters = LettersOf(limb, stem, chain);
  std::string from = parent;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const std::string part = name.side + letters[i] + "_" + stem + "_" + body_id;
    const std::string child = i + 1 == chain.size() ? link : part;
    joints.push_back({chain[i].is_hinge ? link : part, from, child, index,
                      i == 0 ? limb.rest_in_parent : geometry::RigidTransform(), false, chain[i]});
    from = child;
  }
}

std::string Numbers(const Vector3d& v) {
  char text[96];
  // + 0.0: no "-0".
  std::snprintf(text, sizeof text, "%.12g %.12g %.12g", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
  return text;
}

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value + 0.0);
  return text;
}

std::string OriginText(const Vector3d& at_m, const Vector3d& rpy_rad = Vector3d::Zero()) {
  return "<origin xyz=\"" + Numbers(at_m) + "\" rpy=\"" + Numbers(rpy_rad) + "\"/>\n";
}

std::string InertialText(const Limb& limb) {
  const Solid solid = SolidOf(limb.shape);
  const Matrix3d inertia = kDensity_kg_per_m3 * solid.inertia_m5;
  std::string text = "    <inertial>\n      " + OriginText(solid.centre_m);
  text += "      <mass value=\"" + Number(kDensity_kg_per_m3 * solid.volume_m3) + "\"/>\n";
  text += "      <inertia ixx=\"" + Number(inertia(0, 0)) + "\" ixy=\"" + Number(inertia(0, 1)) +
          "\" ixz=\"" + Number(inertia(0, 2)) + "\" iyy=\"" + Number(inertia(1, 1)) + "\" iyz=\"" +
          Number(inertia(1, 2)) + "\" izz=\"" + Number(inertia(2, 2)) + "\"/>\n";
  return text + "    </inertial>\n";
}

/// `kind` is visual or collision.
std::string ShapeText(const Limb& limb, const std::string& kind) {
  const auto& shape = limb.shape;
  const Eigen::Vector2d beside_m = 0.5 * (shape.centre0_m + shape.centre1_m);
  std::string text =
      "    <" + kind + ">\n      " + OriginText({beside_m.x(), beside_m.y(), 0.5 * shape.length_m});
  text += "      <geometry><cylinder radius=\"" + Number(MeanRadius_m(shape)) + "\" length=\"" +
          Number(shape.length_m) + "\"/></geometry>\n";
  return text + "    </" + kind + ">\n";
}

std::string LinkText(const Limb& limb, const std::string& link) {
  return "  <link name=\"" + link + "\">\n" + InertialText(limb) + ShapeText(limb, "visual") +
         ShapeText(limb, "collision") + "  </link>\n";
}

std::string JointText(const UrdfJoint& joint) {
  const std::string type = joint.is_fixed ? "fixed" : "revolute";
  std::string text = "  <joint name=\"" + joint.name + "\" type=\"" + type + "\">\n";
  text += "    <parent link=\"" + joint.parent + "\"/>\n    <child link=\"" + joint.child +
          "\"/>\n    " +
          OriginText(joint.parent_from_joint.translation_m,
                     RollPitchYaw(joint.parent_from_joint.rotation.toRotationMatrix()));
  if (!joint.is_fixed) {
    // URDF demands effort and velocity; the model knows no such limits.
    text += "    <axis xyz=\"" + Numbers(joint.turn.axis) + "\"/>\n    <limit lower=\"" +
            Number(joint.turn.angle_min_rad) + "\" upper=\"" + Number(joint.turn.angle_max_rad) +
            "\" effort=\"1000\" velocity=\"10\"/>\n";
  }
  return text + "  </joint>\n";
}

/// Throws ConfigError for a name with characters of XML's own, or that XML cannot hold.
void CheckName(const std::string& name) {
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f || std::string("<>&\"").find(c) != std::string::npos) {
      throw config::ConfigError("the name '" + name +
                                "' cannot stand in a URDF: leave out <, >, &, \" and controls");
    }
  }
}

void CheckNames(const BodyModel& model, const std::vector<UrdfJoint>& joints) {
  CheckName(model.name());
  std::set<std::string> links = {joints[0].parent}, names;  // The link that all hang on.
  for (const UrdfJoint& joint : joints) {
    CheckName(joint.child);
    if (!links.insert(joint.child).second) {
      throw config::ConfigError("two limbs, or one and the root, would be the link " + joint.child +
                                " of a URDF");
    }
    if (!names.insert(joint.name).second) {
      throw config::ConfigError("two limbs would have the joint " + joint.name + " of a URDF");
    }
  }
}

}  // namespace

Vector3d RollPitchYaw(const Matrix3d& rotation) {
  const double level = std::hypot(rotation(0, 0), rotation(1, 0));
  const double yaw = level < 1e-9 ? 0.0 : std::atan2(rotation(1, 0), rotation(0, 0));
  const double pitch = std::atan2(-rotation(2, 0), level);
  const Matrix3d left =
      (Eigen::AngleAxisd(yaw, Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Vector3d::UnitY()))
          .toRotationMatrix()
          .transpose() *
      rotation;
  return {std::atan2(left(2, 1), left(1, 1)), pitch, yaw};
}

std::vector<UrdfJoint> UrdfJoints(const BodyModel& model, const std::string& body_id) {
  const auto& limbs = model.limbs();
  std::vector<UrdfJoint> joints;
  const std::string base = LinkOf(limbs[0], body_id);
  joints.push_back({base, "body_" + body_id, base, 0, {}, true, {}});
  for (std::size_t i = 1; i < limbs.size(); ++i) {
    AppendChain(limbs[i], static_cast<int>(i),
                LinkOf(limbs[static_cast<std::size_t>(limbs[i].parent)], body_id), body_id, joints);
  }
  return joints;
}

std::vector<JointValue> JointValues(const BodyModel& model, const std::vector<UrdfJoint>& joints,
                                    const body_model::BodyPose& pose) {
  std::vector<JointValue> values;
  Eigen::VectorXd angles;
  Eigen::Index place = 0;
  int limb = -1;
  for (const UrdfJoint& joint : joints) {
    if (joint.is_fixed) continue;
    if (joint.limb != limb) {
      limb = joint.limb;
      place = 0;
      const Limb& moved = model.limbs()[static_cast<std::size_t>(limb)];
      angles =
          ChainAngles(moved, pose.angles_rad.segment(model.first_angle(limb),
                                                     static_cast<Eigen::Index>(moved.dofs.size())));
    }
    values.push_back({joint.name, angles[place++]});
  }
  return values;
}

std::string UrdfOf(const BodyModel& model, const std::string& body_id) {
  const auto joints = UrdfJoints(model, body_id);
  CheckNames(model, joints);
  std::string text = "<?xml version=\"1.0\"?>\n<robot name=\"" + model.name() + "\">\n";
  text += "  <link name=\"body_" + body_id + "\"/>\n";
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const UrdfJoint& joint = joints[i];
    // The last joint of a limb carries it; those before carry nothing.
    const bool is_last = i + 1 == joints.size() || joints[i + 1].limb != joint.limb;
    const Limb& limb = model.limbs()[static_cast<std::size_t>(joint.limb)];
    text += is_last ? LinkText(limb, joint.child) : "  <link name=\"" + joint.child + "\"/>\n";
    text += JointText(joint);
  }
  return text + "</robot>\n";
}

}  // namespace deixis::anthropometer

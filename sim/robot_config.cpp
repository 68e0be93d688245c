#include "reckon/sim/robot_config.h"

namespace reckon::sim {

bool IsWheelJoint(const models::UrdfRobot& urdf, const models::UrdfJoint& joint,
                  const std::string& base_link) {
  return joint.type == models::JointType::kContinuous &&
         urdf.links()[joint.parent].name == base_link;
}

}  // namespace reckon::sim

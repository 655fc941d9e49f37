#pragma once
#include <string>
#include <utility>
#include <vector>

#include "common/scene/object.h"

namespace deixis::scene {

/// The words for kinds of objects in configuration files.
inline auto EnumNames(ObjectKind) {
  return std::vector<std::pair<std::string, ObjectKind>>{{"face", ObjectKind::kFace},
                                                         {"object", ObjectKind::kObject},
                                                         {"marker", ObjectKind::kMarker},
                                                         {"place", ObjectKind::kPlace}};
}

}  // namespace deixis::scene

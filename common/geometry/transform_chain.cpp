#include "common/geometry/transform_chain.h"

#include <algorithm>
#include <utility>

namespace deixis::geometry {
namespace {

bool LinksSame(const FrameTransform& a, const FrameTransform& b) {
  return (a.parent == b.parent && a.child == b.child) ||
         (a.parent == b.child && a.child == b.parent);
}

/// The frame at the other end; nullptr when `frame` is at neither.
const std::string* OtherEnd(const FrameTransform& transform, const std::string& frame) {
  if (transform.parent == frame) return &transform.child;
  return transform.child == frame ? &transform.parent : nullptr;
}

/// A frame that a search has come to, by which link and from which frame before.
struct Reached {
  const std::string* frame = nullptr;
  std::size_t link = 0;
  std::size_t before = 0;
};

bool Has(const std::vector<Reached>& reached, const std::string& frame) {
  return std::any_of(reached.begin(), reached.end(),
                     [&frame](const Reached& other) { return *other.frame == frame; });
}

std::vector<std::size_t> LinksTo(std::size_t end, const std::vector<Reached>& reached) {
  std::vector<std::size_t> links;
  for (std::size_t i = end; i != 0; i = reached[i].before) links.push_back(reached[i].link);
  std::reverse(links.begin(), links.end());
  return links;
}

std::string Quoted(const std::string& name) { return "'" + name + "'"; }

}  // namespace

TransformChain::TransformChain(std::string parent_frame) : parent_frame_(std::move(parent_frame)) {}

void TransformChain::SetCameraFrame(const std::string& camera_frame) {
  if (camera_frame == camera_frame_) return;
  camera_frame_ = camera_frame;
  FindChain();
}

std::optional<CameraPose> TransformChain::Take(const FrameTransforms& transforms) {
  ++messages_;
  for (const FrameTransform& transform : transforms) Keep(transform);
  if (is_chain_old_) FindChain();
  if (!chain_) return std::nullopt;
  const bool is_new = std::any_of(chain_->begin(), chain_->end(), [this](std::size_t link) {
    return links_[link].heard == messages_;
  });
  if (!is_new) return std::nullopt;
  return Pose();
}

void TransformChain::Keep(const FrameTransform& transform) {
  const auto known = std::find_if(links_.begin(), links_.end(), [&transform](const Link& link) {
    return LinksSame(link.transform, transform);
  });
  if (known == links_.end()) is_chain_old_ = true;
  (known == links_.end() ? RoomForNew() : *known) = {transform, messages_};
}

TransformChain::Link& TransformChain::RoomForNew() {
  if (links_.size() < kMostTransforms) return links_.emplace_back();
  Link* oldest = nullptr;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const bool is_in_chain =
        chain_ && std::find(chain_->begin(), chain_->end(), i) != chain_->end();
    if (is_in_chain || (oldest != nullptr && oldest->heard <= links_[i].heard)) continue;
    oldest = &links_[i];
  }
  // A chain as long as all that is kept: its own last link goes.
  return oldest != nullptr ? *oldest : links_.back();
}

// Breadth first: each frame is come to once, whatever circles there are.
void TransformChain::FindChain() {
  is_chain_old_ = false;
  chain_.reset();
  std::vector<Reached> reached{{&parent_frame_}};
  for (std::size_t i = 0; i < reached.size(); ++i) {
    if (*reached[i].frame == camera_frame_) {
      chain_ = LinksTo(i, reached);
      return;
    }
    for (std::size_t link = 0; link < links_.size(); ++link) {
      const std::string* next = OtherEnd(links_[link].transform, *reached[i].frame);
      if (next != nullptr && !Has(reached, *next)) reached.push_back({next, link, i});
    }
  }
}

CameraPose TransformChain::Pose() const {
  CameraPose pose;
  const std::string* frame = &parent_frame_;
  for (const std::size_t link : *chain_) {
    const FrameTransform& step = links_[link].transform;
    const bool goes_down = step.parent == *frame;
    pose.parent_from_camera =
        pose.parent_from_camera *
        (goes_down ? step.parent_from_child : Inverse(step.parent_from_child));
    pose.time.microseconds = std::max(pose.time.microseconds, step.time.microseconds);
    frame = goes_down ? &step.child : &step.parent;
  }
  return pose;
}

std::string TransformChain::WhatLacks() const {
  if (camera_frame_.empty()) return "the camera's frame is not known";
  if (chain_) return "";
  for (const std::string& end : {parent_frame_, camera_frame_}) {
    if (!IsNamed(end)) return "no transform names " + Quoted(end);
  }
  return "no transform leads from " + WithTop(parent_frame_) + " to " + WithTop(camera_frame_);
}

bool TransformChain::IsNamed(const std::string& frame) const {
  return std::any_of(links_.begin(), links_.end(), [&frame](const Link& link) {
    return OtherEnd(link.transform, frame) != nullptr;
  });
}

std::string TransformChain::WithTop(const std::string& frame) const {
  const std::string top = TopOf(frame);
  return top == frame ? Quoted(frame) : Quoted(top) + " (above " + Quoted(frame) + ")";
}

// In a circle there is no top: the steps are counted.
std::string TransformChain::TopOf(std::string frame) const {
  for (std::size_t step = 0; step < links_.size(); ++step) {
    const auto above = std::find_if(links_.begin(), links_.end(), [&frame](const Link& link) {
      return link.transform.child == frame;
    });
    if (above == links_.end()) break;
    frame = above->transform.parent;
  }
  return frame;
}

}  // namespace deixis::geometry

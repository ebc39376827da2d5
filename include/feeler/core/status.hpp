// What a call of the renderer can say about its result.
#pragma once

namespace feeler {

/// The truth about a pose that `reset` or `update` left behind; every output is valid after every status.
enum class TickStatus {
  converged,       ///< the graphic pose is a local minimum to tolerance, free of collision, reached on a certified path
  unconverged,     ///< free of collision and reached on a certified path, but work was left for the next ticks
  unverified,      ///< a contact method without a certificate chose the graphic pose: it may penetrate the object
  penetrating,     ///< `reset` only: the pose given penetrates the object; the renderer holds no pose
  inside,  ///< `reset` only: at the pose given the tool is in what the object encloses, and touches no triangle; the renderer holds no pose
  not_finite,  ///< the pose given has a NaN, a number too large to be squared, or a quaternion too short to be normalised; the last graphic pose and wrench are kept
  not_reset,  ///< `update` before a successful `reset`; the haptic pose is passed through with no wrench
};

#if !defined(Status)  // X11's is a macro
using Status = TickStatus;
#endif

/// One sentence for a log or a message box.
constexpr const char* to_string(TickStatus status) noexcept {
  switch (status) {
    case TickStatus::converged: return "converged: the pose is a local minimum and free of collision";
    case TickStatus::unconverged: return "unconverged: the pose is free of collision; the rest of the motion follows in the next ticks";
    case TickStatus::unverified: return "unverified: the contact method proves nothing; the pose may penetrate";
    case TickStatus::penetrating: return "penetrating: start from a pose that does not touch the object, such as nearest_free_pose finds";
    case TickStatus::inside: return "inside: the tool is in the solid of the object; start outside, from what nearest_free_pose finds";
    case TickStatus::not_finite:
      return "not finite: the pose has a NaN, a number too large to be squared, or a quaternion near zero; the last pose is kept";
    case TickStatus::not_reset: return "not reset: call reset with a free pose first";
  }
  return "unknown status";
}

}  // namespace feeler

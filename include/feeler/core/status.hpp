// What a call of the renderer can say about its result.
#pragma once

namespace feeler {

/// The truth about a pose that `reset` or `update` left behind; every output is valid after every status.
enum class Status {
  converged,       ///< the graphic pose is a local minimum to tolerance, free of collision, reached on a certified path
  unconverged,     ///< free of collision and reached on a certified path, but work was left for the next ticks
  unverified,      ///< a contact method without a certificate chose the graphic pose: it may penetrate the object
  penetrating,     ///< `reset` only: the pose given penetrates the object; the renderer holds no pose
  not_finite,      ///< the pose given has a NaN, an infinity or a zero quaternion; the last graphic pose and wrench are kept
  not_reset,       ///< `update` before a successful `reset`; the haptic pose is passed through with no wrench
};

/// One sentence for a log or a message box.
constexpr const char* to_string(Status status) noexcept {
  switch (status) {
    case Status::converged: return "converged: the pose is a local minimum and free of collision";
    case Status::unconverged: return "unconverged: the pose is free of collision; the rest of the motion follows in the next ticks";
    case Status::unverified: return "unverified: the contact method proves nothing; the pose may penetrate";
    case Status::penetrating: return "penetrating: start from a pose that does not touch the object";
    case Status::not_finite: return "not finite: the pose has a NaN, an infinity or a zero quaternion; the last pose is kept";
    case Status::not_reset: return "not reset: call reset with a free pose first";
  }
  return "unknown status";
}

}  // namespace feeler

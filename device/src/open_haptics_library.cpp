// Loads libHD.so and says what is missing.
#include "open_haptics_library.hpp"

namespace feeler::open_haptics {

std::string Library::load(const std::vector<std::string>& candidates) {
  const std::string refusal = file.load(candidates);
  if (!refusal.empty()) {
    const bool lacks_ncurses = refusal.find("libncurses") != std::string::npos;
    return "OpenHaptics: libHD.so cannot be loaded (" + refusal + "): " +
           (lacks_ncurses ? "install libncurses5, which the driver still needs."
                          : "install OpenHaptics and the device driver from the support pages of 3D Systems, "
                            "then run ldconfig.");
  }
  for (const char* const missing : {
           file.find("hdInitDevice", init_device),
           file.find("hdDisableDevice", disable_device),
           file.find("hdMakeCurrentDevice", make_current_device),
           file.find("hdBeginFrame", begin_frame),
           file.find("hdEndFrame", end_frame),
           file.find("hdGetError", get_error),
           file.find("hdGetErrorString", get_error_string),
           file.find("hdEnable", enable),
           file.find("hdDisable", disable),
           file.find("hdGetBooleanv", get_booleans),
           file.find("hdGetIntegerv", get_integers),
           file.find("hdGetDoublev", get_doubles),
           file.find("hdGetString", get_string),
           file.find("hdSetDoublev", set_doubles),
           file.find("hdCheckCalibration", check_calibration),
           file.find("hdUpdateCalibration", update_calibration),
           file.find("hdStartScheduler", start_scheduler),
           file.find("hdStopScheduler", stop_scheduler),
           file.find("hdScheduleAsynchronous", schedule_asynchronous),
           file.find("hdUnschedule", unschedule),
       }) {
    if (missing != nullptr) {
      return "OpenHaptics: " + file.path() + " has no function " + missing + ": install OpenHaptics 3.0 or later, or point to its libHD.so.";
    }
  }
  return {};
}

const char* sentence_of(unsigned int code) noexcept {
  switch (code) {
    case warm_motors: return "The motors are warm (0x0200): let the device rest.";
    case exceeded_max_force: return "More force was asked for than the device allows (0x0201): lower the stiffness.";
    case exceeded_max_force_impulse:
      return "The force changed faster than the device allows (0x0202): lower the stiffness or the slew "
             "limit.";
    case exceeded_max_velocity: return "The handle moved faster than the device allows (0x0203): hold it firmly.";
    case force_error: return "The device reports a force error (0x0204): let go, then start again.";
    case device_fault: return "The device reports a fault (0x0300): wait, and if it stays, switch it off and on.";
    case device_already_initiated: return "The device is in use already (0x0301): close the other program that has opened it.";
    case communication_error:
      return "The device does not answer (0x0302): check its power and cable, and that you may write to its "
             "node in /dev "
             "(/dev/hidraw*, ttyACM* or raw1394; a udev rule of the driver grants it).";
    case communication_configuration:
      return "The connection of the device is configured wrongly (0x0303): run the setup program of its "
             "driver.";
    case timer_error: return "The driver cannot start its servo timer (0x0304): end other programs that use the device.";
    case invalid_license: return "OpenHaptics finds no valid licence (0x0600): install the licence that came with it.";
    default: return nullptr;
  }
}

bool ends_session(unsigned int code) noexcept {
  switch (code) {
    case bad_handle:
    case communication_error:
    case communication_configuration:
    case timer_error:
    case invalid_priority:
    case scheduler_full: return true;
    default: return false;
  }
}

}  // namespace feeler::open_haptics

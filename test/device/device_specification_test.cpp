// The presets of known devices: what must hold of each, whatever its figures.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <set>
#include <string>

#include "feeler/device/device_specification.hpp"

BOOST_AUTO_TEST_SUITE(device_specification)

BOOST_AUTO_TEST_CASE(every_preset_has_figures_that_agree_with_each_other) {
  std::set<std::string> names;
  for (const auto& device :
       {feeler::phantom_premium_3_0_6dof(), feeler::phantom_premium_1_5_6dof(), feeler::phantom_premium_1_5_high_force_6dof(), feeler::touch(),
        feeler::touch_x(), feeler::omega_3(), feeler::omega_6(), feeler::omega_7(), feeler::sigma_7(), feeler::lambda_7(), feeler::delta_3(),
        feeler::falcon(), feeler::virtuose_6d(), feeler::virtuose_6d_desktop(), feeler::inverse3()}) {
    BOOST_TEST_CONTEXT(device.name) {
      BOOST_TEST(names.insert(device.name).second);
      BOOST_TEST(device.minimum_rate > 0);
      BOOST_TEST(device.minimum_rate <= device.nominal_rate);
      BOOST_TEST(device.nominal_rate <= device.maximum_rate);
      BOOST_TEST(device.continuous_force > 0);
      BOOST_TEST(device.continuous_force <= device.maximum_force);
      BOOST_TEST(device.continuous_torque <= device.maximum_torque);
      BOOST_TEST(device.stiffness > 0);
      BOOST_TEST((device.maximum_torque > 0) == device.pushes_torque());
      BOOST_TEST((device.continuous_torque > 0) == device.pushes_torque());
      BOOST_TEST((device.rotational_stiffness > 0) == device.pushes_torque());
      for (std::size_t axis = 0; axis < 6; ++axis) BOOST_TEST((device.is_sensed[axis] || !device.is_pushed[axis]));
      BOOST_TEST(*std::min_element(device.workspace.begin(), device.workspace.end()) > 0);
      BOOST_TEST(device.position_resolution > 0);
      BOOST_TEST(device.apparent_mass > 0);
      // A wall of the preset's stiffness at 1 kHz is passive: b ≥ K T / 2 (Colgate and Schenkel), to a tenth.
      BOOST_TEST(device.damping >= 0.9 * device.stiffness * 1e-3 / 2);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_device_that_loses_its_torque_is_force_only) {
  auto device = feeler::sigma_7();
  device.lose_torque();
  BOOST_TEST(!device.pushes_torque());
  BOOST_TEST(device.maximum_torque == 0);
  BOOST_TEST(device.is_pushed[0]);
  BOOST_TEST(device.is_sensed[5]);
}

BOOST_AUTO_TEST_SUITE_END()

// The scenes of the battery: mostly a cube on a plate, each with something at an end.
#pragma once

#include <functional>
#include <string>

#include "fuzz/laws/surface.hpp"
#include "scenes/motions.hpp"
#include "study/player.hpp"

namespace feeler::extremes {

using scenes::Vector;
using study::StudyScene;

Points<double> block(const Vector& half);
/// A tool pressed on a surface by a hand that comes down, turns and goes along.
/// @param size  half of the tool's height [m]
StudyScene pressed(const laws::Surface& surface, const Points<double>& tool, double size);
laws::Surface plate_of(double half, int cells = 1);
StudyScene cube_on_plate(double scale = 1, double offset = 0);
/// A cube between two plates.
StudyScene cube_in_slot(double clearance);
/// The nearest pose of a cube that has no room between two plates: in their middle, upright, and else with the hand.
std::function<double(const Pose<double>&, const Pose<study::Wide>&)> off_the_middle(double clearance);
/// A plate whose triangles are cut so that one row of them is long and thin.
StudyScene on_slivers(double aspect);
/// The plate with something wrong with its triangles.
StudyScene on_broken_plate(const std::string& fault);
/// Each triangle of the plate drawn together towards its middle, which leaves cracks.
StudyScene on_cracked_plate(double width);
/// A tool that lies flat on a flat plate, but for a turn by some units in the last place.
StudyScene flush(double turn);
/// The hand is turned about the vertical, or over, by so much.
StudyScene turned_by(double angle, const Vector& axis);
/// A device that goes on by steps of one length and turn, to and fro across the plate.
StudyScene stepping(double length, double turn);
StudyScene with_encoder_noise(double count);
StudyScene with_hand(const Pose<double>& bad);
StudyScene with_stiffness(double hardness, double length);
StudyScene in_soup(int count);

}  // namespace feeler::extremes

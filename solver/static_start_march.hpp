// Static shape of a line with a free end: integrated from that end, whose force is known, to the held one.
//
//   G(m) = - sum of all loads between the free end and m,   dr/dm = (1 + |G|/EA) G/|G|
//
// m = unstretched arc length from the free end; G is what the held side must pull with. Loads are weight, drag
// (theory 5.1, direction and depth of the place) and bodies. At a bare end G = 0: the line leaves along its own load,
// q(t) parallel to t (the critical angle of a towed cable). Depths count from the held end, so the integration is
// repeated until the position of the free end repeats.
#pragma once

#include "solver/static_start_shape.hpp"

namespace hawser {

/// Shape of a line of which exactly one end is free. `held` is the position of the other one at t = 0.
LineShape march_from_free_end(const Model& model, int line, const Vec3& held);

}  // namespace hawser

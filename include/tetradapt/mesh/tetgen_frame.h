// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_tetgen_frame_h
#define tetradapt_mesh_tetgen_frame_h

#include "tetradapt/mesh/tetgen_protocol.h"

#include <array>

namespace tetradapt::mesh
{
  /**
   * The coordinates in which TetGen works: some of its tolerances are absolute, so that
   * the mesh of a body of one nanometre, or of one far from the origin, would not be that
   * of the same body in other units or elsewhere.
   *
   * x' = 2^k (x - o), where k brings the longest side of the bounding box between 1/2 and
   * 1, and o is its lower corner if the body is far from the origin (more than eight times
   * its extent, in that direction), and zero otherwise. Both steps are then exact in
   * floating point, and so are the steps back: given points return bit by bit, and new
   * points on an axis-parallel plane lie on that plane.
   */
  class TetgenFrame
  {
  public:
    /** The frame of @p points, three numbers a point, all finite. */
    explicit TetgenFrame(const std::vector<double> &points);

    /** Brings points, sizes, bounds on volumes and the points of regions of @p request into
     * the frame; its switches are left alone: see volume(). */
    void
    enter(TetgenRequest &request) const;

    /** Brings the points of @p reply back. */
    void
    leave(TetgenReply &reply) const;

    /** What @p volume is in the frame. */
    double
    volume(double volume) const;

  private:
    std::array<double, 3> origin{{0., 0., 0.}};
    int                   exponent = 0; ///< the k above
  };
} // namespace tetradapt::mesh

#endif

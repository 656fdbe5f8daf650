// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_geometry_border_search_h
#define tetradapt_source_geometry_border_search_h

#include "border_curves.h"

#include "tetradapt/core/condition.h"

#include <functional>

namespace tetradapt::geometry
{
  /** Finds the border of one condition on a surface, part by part. */
  class BorderSearch
  {
  public:
    /** Keeps references to all, which must live longer. */
    BorderSearch(const SurfaceMesh                             &surface,
                 const FlatPartList                            &parts,
                 const core::Condition                         &condition,
                 const CutScale                                &scale,
                 const std::function<double(const Point<3> &)> &local_size);

    /** The border in a flat part, as polylines; see cut_surface() about curved ones. */
    std::vector<std::vector<Point<3>>>
    in_part(unsigned int part) const;

  private:
    /** A leaf's border in a part. */
    struct Track
    {
      const PartOfSurface &part;
      unsigned int         leaf;
      bool                 straight;
    };

    std::vector<bool>
    truths(const Point<3> &point) const;

    /** The point of the leaf's border beside the middle of a chord; the middle itself if
     * there is none as near as half its length. */
    Point<3>
    beside(const Track &track, const Point<3> &a, const Point<3> &b, double t) const;

    /** The same, but the point of the chord where the border bulges out of the part. */
    Point<3>
    inside(const Track &track, const Point<3> &a, const Point<3> &b, double t) const;

    /** Where other leaves change along a chord, with 0 and 1. */
    std::vector<double>
    breaks(const Track &track, const Point<3> &a, const Point<3> &b) const;

    /** Whether the condition differs on the two sides of a chord, at its middle. */
    bool
    is_border(const Track &track, const Point<3> &a, const Point<3> &b) const;

    std::vector<BorderCurve>
    pieces_on_border(const Track &track, const BorderCurve &curve) const;

    /** With few chords. */
    std::vector<Point<3>>
    chords(const Track &track, const BorderCurve &curve) const;

    void
    add_chords(const Track                 &track,
               const std::vector<Point<3>> &curve,
               std::size_t                  begin,
               std::size_t                  end,
               std::vector<Point<3>>       &result) const;

    void
    add_halves(const Track           &track,
               const Point<3>        &a,
               const Point<3>        &b,
               unsigned int           depth,
               std::vector<Point<3>> &result) const;

    double
    allowed_sagitta(const Track &track, const Point<3> &a, const Point<3> &b) const;

    const SurfaceMesh                             &surface;
    const FlatPartList                            &parts;
    const core::Condition                         &condition;
    const CutScale                                &scale;
    const std::function<double(const Point<3> &)> &local_size;
    std::vector<std::vector<double>>               levels; ///< of each leaf at the points
  };
} // namespace tetradapt::geometry

#endif

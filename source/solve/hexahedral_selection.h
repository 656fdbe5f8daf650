// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_solve_hexahedral_selection_h
#define tetradapt_source_solve_hexahedral_selection_h

#include "tetradapt/core/condition.h"
#include "tetradapt/core/log.h"
#include "tetradapt/solve/hexahedral_grid.h"

#include <memory>

/** Which sides of bricks a support or a load selects. */
namespace tetradapt::solve::hexahedral
{
  /** A rectangle of the boundary: the side of a brick. */
  struct Rectangle
  {
    unsigned int brick, side;
    Point<3>     lower, upper;

    /** The first axis of its plane; the second is the next one, cyclically. */
    unsigned int
    first_axis() const
    {
      return (side / 2 + 1) % 3;
    }
    /** The point at fractions of the two directions of the plane. */
    Point<3>
    at(double s, double t) const;
    double
    area() const;
  };

  Rectangle
  rectangle(const HexahedralGrid &grid, unsigned int brick, unsigned int side);

  /** All outer sides. */
  std::vector<Rectangle>
  boundary(const HexahedralGrid &grid);

  /** Longest edge of the grid's bounding box. */
  double
  extent(const HexahedralGrid &grid);

  /** The brick that holds the centre of brick @p inner of a finer grid. */
  unsigned int
  brick_around(const HexahedralGrid &grid, const HexahedralGrid &finer, unsigned int inner);

  /** The grid with other planes, which must be the old ones and more; without sides. */
  HexahedralGrid
  with_planes(const HexahedralGrid &old, const std::array<std::vector<double>, 3> &planes);

  /** Adds planes, those that are nearly the same once. */
  void
  merge_planes(std::array<std::vector<double>, 3>       &planes,
               const std::array<std::vector<double>, 3> &others,
               double                                    extent);

  /** A support's or a face load's choice of sides. */
  class Selection
  {
  public:
    Selection(const std::string &name, const scene::Selector &selector);

    const std::string &
    name() const
    {
      return full_name;
    }
    /** Whether it has an expression, and not only lists. */
    bool
    is_spatial() const
    {
      return expression != nullptr;
    }
    /** Whether a side (0 to 5) is listed by id or group, or there is no list. */
    bool
    lists(unsigned int side) const;
    /** Whether the expression holds. */
    bool
    holds(const Point<3> &p) const;
    /** Listed, and the expression holds at the corners and the centre. */
    bool
    selects(const Rectangle &r) const;
    double
    area(const std::vector<Rectangle> &rectangles) const;

  private:
    std::string                      full_name;
    scene::Selector                  selector;
    std::unique_ptr<core::Condition> expression;
  };

  /**
   * The grid itself, or with more planes if the sides selected on it do not have
   * @p wanted_area: those on which the expression changes.
   * @throws core::InputError if the border of the selection lies in no such planes.
   */
  HexahedralGrid
  resolved(const HexahedralGrid &grid,
           const Selection      &selection,
           double                wanted_area,
           const core::Log      &log);
} // namespace tetradapt::solve::hexahedral

#endif

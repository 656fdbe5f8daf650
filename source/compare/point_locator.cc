// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/point_locator.h"

#include "tetradapt/compare/cell_search.h"
#include "tetradapt/compare/walk_cell.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/face_table.h"
#include "tetradapt/mesh/space_curve.h"

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetradapt::compare
{
  using internal::WalkCell;

  namespace
  {
    constexpr unsigned int no_cell = dealii::numbers::invalid_unsigned_int;
  }

  struct PointLocator::Implementation
  {
    explicit Implementation(std::shared_ptr<const mesh::TetMesh> mesh);

    Location
    locate(const Point<3> &p, unsigned int start) const;
    unsigned int
    walk(const Point<3> &p, unsigned int start) const;
    bool
    accept(const Point<3> &p, unsigned int cell, Location &location) const;
    Location
    search(const Point<3> &p) const;
    unsigned int
    guess(const Point<3> &p) const;
    Location
    from(const CellSearch::Nearest &nearest) const;

    std::shared_ptr<const mesh::TetMesh>     mesh;
    std::vector<std::array<unsigned int, 4>> neighbours; ///< in the mesh's numbering
    mesh::SpaceCurve                         curve;
    std::vector<WalkCell>                    cells; ///< sorted along the curve
    std::vector<std::uint64_t>               codes; ///< of the cells' centroids, sorted
    std::vector<unsigned int>                place; ///< of the mesh's cells in cells
    std::unique_ptr<CellSearch>              trees;
    double                                   tolerance; ///< a distance
    unsigned int                             max_steps;
  };

  PointLocator::Implementation::Implementation(std::shared_ptr<const mesh::TetMesh> mesh_)
    : mesh(std::move(mesh_)),
      curve(mesh::bounding_box(*mesh).first, mesh::bounding_box(*mesh).second)
  {
    const unsigned int n = mesh->n_cells();
    if (n == 0)
      throw core::InputError("Points cannot be located in a mesh without tetrahedra.");
    neighbours = mesh::cell_neighbors(*mesh);

    // Two contributions: rounding of the coordinates themselves, which grows with
    // the distance from the origin, and of computed points on faces.
    const auto [low, high] = mesh::bounding_box(*mesh);
    double largest         = 0.;
    for (unsigned int d = 0; d < 3; ++d)
      largest = std::max({largest, std::abs(low[d]), std::abs(high[d])});
    tolerance
      = 1e-12 * (high - low).norm() + 16. * std::numeric_limits<double>::epsilon() * largest;

    // A straight walk crosses some n^(1/3) cells; graded meshes take more.
    max_steps = 100 + static_cast<unsigned int>(10. * std::cbrt(double(n)));

    std::vector<Point<3>> centroids(n);
    for (unsigned int cell = 0; cell < n; ++cell)
      for (unsigned int d = 0; d < 3; ++d)
        centroids[cell][d]
          = 0.25
            * (mesh->points[mesh->cells[cell][0]][d] + mesh->points[mesh->cells[cell][1]][d]
               + mesh->points[mesh->cells[cell][2]][d] + mesh->points[mesh->cells[cell][3]][d]);
    const auto order = curve.order(centroids);
    place.resize(n);
    for (unsigned int i = 0; i < n; ++i)
      place[order[i]] = i;
    cells.resize(n);
    codes.resize(n);
    for (unsigned int i = 0; i < n; ++i)
      {
        const auto &vertices = mesh->cells[order[i]];
        WalkCell   &cell     = cells[i];
        cell.number          = order[i];
        codes[i]             = curve(centroids[order[i]]);
        for (unsigned int f = 0; f < 4; ++f)
          {
            const unsigned int other = neighbours[order[i]][f];
            cell.neighbours[f]       = other == no_cell ? no_cell : place[other];
          }
        cell.set_geometry({{&mesh->points[vertices[0]],
                            &mesh->points[vertices[1]],
                            &mesh->points[vertices[2]],
                            &mesh->points[vertices[3]]}},
                          tolerance);
      }
    trees = std::make_unique<CellSearch>(*mesh, neighbours);
  }

  Location
  PointLocator::Implementation::from(const CellSearch::Nearest &nearest) const
  {
    return {nearest.cell,
            nearest.barycentric,
            nearest.distance > tolerance ? nearest.distance : 0.};
  }

  /** A cell whose centroid is close to @p p on the curve. */
  unsigned int
  PointLocator::Implementation::guess(const Point<3> &p) const
  {
    const auto it = std::lower_bound(codes.begin(), codes.end(), curve(p));
    return std::min<std::size_t>(it - codes.begin(), codes.size() - 1);
  }

  /**
   * Visibility walk: leaves each cell through the face that @p p lies farthest
   * behind, in barycentric measure. Returns a cell that holds @p p up to its
   * margin, or no_cell if the walk ends at the boundary or runs in circles, as
   * it may do in meshes that are not Delaunay.
   */
  unsigned int
  PointLocator::Implementation::walk(const Point<3> &p, const unsigned int start) const
  {
    unsigned int current = start;
    for (unsigned int step = 0; step < max_steps; ++step)
      {
        const WalkCell   &cell = cells[current];
        mesh::Barycentric b    = cell.invert(p);
        if (internal::smallest(b) >= -cell.margin)
          return current;
        unsigned int next = no_cell;
        double       most = -cell.margin;
        for (unsigned int i = 0; i < 4; ++i)
          if (b[i] < most && cell.neighbours[i] != no_cell)
            {
              most = b[i];
              next = cell.neighbours[i];
            }
        if (next == no_cell)
          return no_cell;
        current = next;
      }
    return no_cell;
  }

  /**
   * Whether @p p lies in @p start up to the tolerance. If it is so close to a
   * face that a neighbour may hold it as well, all cells around that face, edge
   * or vertex are compared, so that the result does not depend on the walk.
   */
  bool
  PointLocator::Implementation::accept(const Point<3>    &p,
                                       const unsigned int start,
                                       Location          &location) const
  {
    mesh::Barycentric best_b = cells[start].invert(p);
    double            best   = internal::smallest(best_b);
    unsigned int      winner = start;
    if (best > cells[start].margin)
      {
        location = internal::clamped(cells[start].number, best_b);
        return true;
      }
    best = -std::numeric_limits<double>::max();
    boost::container::small_vector<unsigned int, 64> queue{start}, seen{start};
    for (std::size_t i = 0; i < queue.size(); ++i)
      {
        const WalkCell         &cell = cells[queue[i]];
        const mesh::Barycentric b    = cell.invert(p);
        std::array<bool, 4>     on_face{};
        bool                    inside = true;
        for (unsigned int f = 0; f < 4; ++f)
          {
            if (b[f] > cell.margin)
              continue; // farther inside than the tolerance
            const double distance = b[f] * cell.height(f);
            inside                = inside && distance >= -tolerance;
            on_face[f]            = distance <= tolerance;
          }
        if (!inside)
          continue;
        const double here = internal::smallest(b);
        if (here > best || (here == best && cell.number < cells[winner].number))
          {
            best   = here;
            best_b = b;
            winner = queue[i];
          }
        for (unsigned int f = 0; f < 4; ++f)
          if (on_face[f] && cell.neighbours[f] != no_cell)
            {
              const auto position = std::lower_bound(seen.begin(), seen.end(), cell.neighbours[f]);
              if (position == seen.end() || *position != cell.neighbours[f])
                {
                  seen.insert(position, cell.neighbours[f]);
                  queue.push_back(cell.neighbours[f]);
                }
            }
      }
    if (best == -std::numeric_limits<double>::max())
      return false;
    // In a flat cell, cutting off a small negative coordinate would move the point
    // farther than the tolerance: there, the true projection.
    if (best < -1e-12)
      location = from(trees->nearest_on_cell(p, cells[winner].number));
    else
      location = internal::clamped(cells[winner].number, best_b);
    return true;
  }

  /** The search that needs no good start: bounding boxes, then distances. */
  Location
  PointLocator::Implementation::search(const Point<3> &p) const
  {
    Location            result;
    CellSearch::Nearest nearest;
    nearest.distance      = std::numeric_limits<double>::max();
    const auto candidates = trees->candidates(p, tolerance);
    for (const unsigned int cell : candidates)
      if (internal::smallest(cells[place[cell]].invert(p)) >= -cells[place[cell]].margin
          && accept(p, place[cell], result))
        return result;
    // Rounding in very flat cells can leave a point inside the mesh in none of
    // them; it is next to one of the candidates, while the boundary is far.
    for (const unsigned int cell : candidates)
      {
        const auto here = trees->nearest_on_cell(p, cell);
        if (here.distance < nearest.distance)
          nearest = here;
      }
    const auto boundary = trees->nearest_on_boundary(p);
    if (boundary.distance < nearest.distance)
      nearest = boundary;
    return from(nearest);
  }

  Location
  PointLocator::Implementation::locate(const Point<3> &p, const unsigned int start) const
  {
    if (!(std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])))
      throw core::NumericalError(
        "A point with a coordinate that is not finite cannot be located in a mesh.");
    Location     result;
    unsigned int cell = walk(p, start);
    if (cell != no_cell && accept(p, cell, result))
      return result;
    return search(p);
  }

  PointLocator::PointLocator(std::shared_ptr<const mesh::TetMesh> mesh)
    : implementation(std::make_unique<Implementation>(std::move(mesh)))
  {
  }

  PointLocator::~PointLocator() = default;

  const mesh::TetMesh &
  PointLocator::mesh() const
  {
    return *implementation->mesh;
  }

  Location
  PointLocator::locate(const Point<3> &point, const unsigned int hint) const
  {
    const bool known = hint < implementation->place.size();
    return implementation->locate(point,
                                  known ? implementation->place[hint]
                                        : implementation->guess(point));
  }

  std::vector<Location>
  PointLocator::locate(const std::vector<Point<3>> &points) const
  {
    std::vector<Location> locations(points.size());
    if (points.empty())
      return locations;
    // Along the curve each walk starts next to its end, whatever the order of
    // the points, and the cells come from the caches.
    const auto   order = implementation->curve.order(points);
    unsigned int start = implementation->guess(points[order[0]]);
    for (const unsigned int i : order)
      {
        locations[i] = implementation->locate(points[i], start);
        start        = implementation->place[locations[i].cell];
      }
    return locations;
  }
} // namespace tetradapt::compare

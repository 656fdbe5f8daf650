// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/cell_search.h"

#include "tetradapt/compare/tet_distance.h"
#include "tetradapt/mesh/face_table.h"

#include <boost/geometry/algorithms/comparable_distance.hpp>
#include <boost/geometry/algorithms/distance.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <mutex>

namespace tetradapt::compare
{
  namespace bg  = boost::geometry;
  namespace bgi = boost::geometry::index;

  namespace
  {
    using BoostPoint = bg::model::point<double, 3, bg::cs::cartesian>;
    using Box        = bg::model::box<BoostPoint>;
    /** A box and the cell (or, for boundary triangles, 4 cell + face) in it. */
    using Entry = std::pair<Box, std::size_t>;
    using Tree  = bgi::rtree<Entry, bgi::rstar<16>>;

    constexpr unsigned int no_cell = dealii::numbers::invalid_unsigned_int;

    BoostPoint
    to_boost(const Point<3> &p)
    {
      return {p[0], p[1], p[2]};
    }

    template <std::size_t n>
    Box
    box_around(const mesh::TetMesh &mesh, const std::array<unsigned int, n> &vertices)
    {
      Point<3> low = mesh.points[vertices[0]], high = low;
      for (std::size_t i = 1; i < n; ++i)
        for (unsigned int d = 0; d < 3; ++d)
          {
            low[d]  = std::min(low[d], mesh.points[vertices[i]][d]);
            high[d] = std::max(high[d], mesh.points[vertices[i]][d]);
          }
      return {to_boost(low), to_boost(high)};
    }

    std::array<unsigned int, 3>
    face_vertices(const mesh::TetMesh &mesh, const unsigned int cell, const unsigned int face)
    {
      const auto &c = mesh.cells[cell];
      return {{c[mesh::face_vertices[face][0]],
               c[mesh::face_vertices[face][1]],
               c[mesh::face_vertices[face][2]]}};
    }

    CellSearch::Nearest
    nearest_on_face(const mesh::TetMesh &mesh,
                    const Point<3>      &p,
                    const unsigned int   cell,
                    const unsigned int   face)
    {
      const auto         v = face_vertices(mesh, cell, face);
      const ClosestPoint closest
        = closest_point_on_triangle(p, mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
      CellSearch::Nearest result;
      result.cell     = cell;
      result.distance = std::sqrt(closest.squared_distance);
      for (unsigned int i = 0; i < 3; ++i)
        result.barycentric[mesh::face_vertices[face][i]] = closest.weights[i];
      return result;
    }
  } // namespace

  struct CellSearch::Trees
  {
    Tree           cells, boundary;
    std::once_flag cells_made, boundary_made;
  };

  CellSearch::CellSearch(const mesh::TetMesh                            &mesh,
                         const std::vector<std::array<unsigned int, 4>> &neighbours)
    : mesh(mesh), neighbours(neighbours), trees(std::make_unique<Trees>())
  {
  }

  CellSearch::~CellSearch() = default;

  std::vector<unsigned int>
  CellSearch::candidates(const Point<3> &p, const double tolerance) const
  {
    std::call_once(trees->cells_made, [this] {
      std::vector<Entry> entries(mesh.n_cells());
      for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
        entries[cell] = {box_around(mesh, mesh.cells[cell]), cell};
      // Constructed from a range, the tree is packed: faster to build and query.
      trees->cells = Tree(entries.begin(), entries.end());
    });
    Point<3> low = p, high = p;
    for (unsigned int d = 0; d < 3; ++d)
      {
        low[d] -= tolerance;
        high[d] += tolerance;
      }
    std::vector<unsigned int> found;
    const Box                 box(to_boost(low), to_boost(high));
    for (auto it = trees->cells.qbegin(bgi::intersects(box)); it != trees->cells.qend(); ++it)
      found.push_back(it->second);
    std::sort(found.begin(), found.end());
    return found;
  }

  CellSearch::Nearest
  CellSearch::nearest_on_boundary(const Point<3> &p) const
  {
    std::call_once(trees->boundary_made, [this] {
      std::vector<Entry> entries;
      for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
        for (unsigned int face = 0; face < 4; ++face)
          if (neighbours[cell][face] == no_cell)
            entries.emplace_back(box_around(mesh, face_vertices(mesh, cell, face)),
                                 std::size_t(4) * cell + face);
      trees->boundary = Tree(entries.begin(), entries.end());
    });
    Nearest best;
    best.distance             = std::numeric_limits<double>::max();
    const BoostPoint   center = to_boost(p);
    std::vector<Entry> boxes;
    // A box's distance bounds its triangle's from below: once the farthest of
    // the k nearest boxes is farther than the best triangle, all others are. (A
    // loop over Boost's incremental iterator takes a hundred times as long.)
    for (std::size_t k = 8, known = 0; known < trees->boundary.size(); k *= 8)
      {
        boxes.clear();
        trees->boundary.query(bgi::nearest(center, unsigned(k)), std::back_inserter(boxes));
        double farthest = 0.;
        for (const Entry &entry : boxes)
          {
            farthest           = std::max(farthest, bg::comparable_distance(center, entry.first));
            const Nearest here = nearest_on_face(mesh, p, entry.second / 4, entry.second % 4);
            if (here.distance < best.distance
                || (here.distance == best.distance && here.cell < best.cell))
              best = here;
          }
        if (std::sqrt(farthest) > best.distance)
          break;
        known = boxes.size();
      }
    return best;
  }

  CellSearch::Nearest
  CellSearch::nearest_on_cell(const Point<3> &p, const unsigned int cell) const
  {
    Nearest best = nearest_on_face(mesh, p, cell, 0);
    for (unsigned int face = 1; face < 4; ++face)
      {
        const Nearest here = nearest_on_face(mesh, p, cell, face);
        if (here.distance < best.distance)
          best = here;
      }
    return best;
  }
} // namespace tetradapt::compare

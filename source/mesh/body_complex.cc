// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/body_complex.h"

#include "tetradapt/geometry/flat_parts.h"
#include "tetradapt/mesh/face_table.h"
#include "tetradapt/mesh/kept_places.h"

#include <algorithm>
#include <limits>
#include <map>

namespace tetradapt::mesh
{
  namespace
  {
    constexpr double no_limit = std::numeric_limits<double>::max();

    constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

    /** A point inside the largest cell of each part of a region. */
    void
    add_seeds(const TetMesh                                  &mesh,
              const std::vector<std::array<unsigned int, 4>> &neighbors,
              PiecewiseLinearComplex                         &plc)
    {
      std::vector<bool>         seen(mesh.n_cells(), false);
      std::vector<unsigned int> stack;
      for (unsigned int first = 0; first < mesh.n_cells(); ++first)
        {
          if (seen[first])
            continue;
          unsigned int largest = first;
          double       volume  = 0.;
          seen[first]          = true;
          stack.push_back(first);
          while (!stack.empty())
            {
              const unsigned int cell = stack.back();
              stack.pop_back();
              const double v = cell_volume(mesh, cell);
              if (v > volume)
                {
                  volume  = v;
                  largest = cell;
                }
              for (const unsigned int other : neighbors[cell])
                if (other != none && !seen[other] && mesh.regions[other] == mesh.regions[cell])
                  {
                    seen[other] = true;
                    stack.push_back(other);
                  }
            }
          Point<3> middle;
          for (const unsigned int v : mesh.cells[largest])
            middle += mesh.points[v] / 4.;
          plc.regions.push_back({middle, mesh.regions[first]});
        }
    }

    /** All triangles that must survive: of the boundary with their patch as id, of walls with
     * ids from the number of patches on, one a pair of regions. */
    geometry::SurfaceMesh
    boundary_and_walls(const TetMesh                                  &mesh,
                       const std::vector<std::array<unsigned int, 4>> &neighbors)
    {
      geometry::SurfaceMesh surface;
      surface.points = mesh.points;
      for (const BoundaryFace &face : mesh.faces)
        {
          surface.triangles.push_back(face.vertices);
          surface.ids.push_back(face.patch);
        }
      const int                          n_patches = mesh.patches.size();
      std::map<std::pair<int, int>, int> wall;
      for (unsigned int cell = 0; cell < neighbors.size(); ++cell)
        for (unsigned int f = 0; f < 4; ++f)
          {
            const unsigned int other = neighbors[cell][f];
            if (other == none || other < cell || mesh.regions[other] == mesh.regions[cell])
              continue;
            const auto pair = std::minmax(mesh.regions[cell], mesh.regions[other]);
            const int  id   = wall.emplace(pair, n_patches + wall.size()).first->second;
            std::array<unsigned int, 3> triangle{};
            for (unsigned int i = 0; i < 3; ++i)
              triangle[i] = mesh.cells[cell][face_vertices[f][i]];
            surface.triangles.push_back(triangle);
            surface.ids.push_back(id);
          }
      return surface;
    }

    /** Chooses points that keep a distance. */
    class Thinning
    {
    public:
      Thinning(const TetMesh &mesh, const std::vector<double> &sizes, const EdgeTable &edges)
        : mesh(mesh), sizes(sizes), first(mesh.n_points() + 1, 0), around(2 * edges.edges.size()),
          blocked(mesh.n_points(), false), visited(mesh.n_points(), 0)
      {
        for (const auto &[a, b] : edges.edges)
          {
            ++first[a + 1];
            ++first[b + 1];
          }
        for (unsigned int p = 0; p < mesh.n_points(); ++p)
          first[p + 1] += first[p];
        std::vector<unsigned int> place(first.begin(), first.end() - 1);
        for (const auto &[a, b] : edges.edges)
          {
            around[place[a]++] = b;
            around[place[b]++] = a;
          }
      }

      bool
      is_blocked(unsigned int point) const
      {
        return blocked[point];
      }

      /** Blocks all points that are too near to @p point, found along edges. */
      void
      choose(unsigned int point)
      {
        ++round;
        visited[point] = round;
        queue.assign(1, point);
        for (std::size_t i = 0; i < queue.size(); ++i)
          for (unsigned int k = first[queue[i]]; k < first[queue[i] + 1]; ++k)
            {
              const unsigned int other = around[k];
              if (visited[other] == round)
                continue;
              visited[other]        = round;
              const double distance = mesh.points[point].distance(mesh.points[other]);
              if (distance < spacing * std::min(sizes[point], sizes[other]))
                blocked[other] = true;
              // Edges need not lead straight there.
              if (distance < 1.5 * spacing * sizes[point])
                queue.push_back(other);
            }
      }

    private:
      static constexpr double spacing = 0.85; ///< by the size

      const TetMesh             &mesh;
      const std::vector<double> &sizes;
      std::vector<unsigned int>  first, around; ///< points around each point
      std::vector<bool>          blocked;
      std::vector<unsigned int>  visited, queue;
      unsigned int               round = 0;
    };

    /** Sizes that the triangles of curved parts allow: what cannot grow is not asked to,
     * or TetGen makes slivers on it. */
    std::vector<double>
    possible_sizes(const geometry::SurfaceMesh            &surface,
                   const std::vector<geometry::PointKind> &kinds,
                   const std::vector<double>              &sizes)
    {
      std::vector<double> longest(surface.points.size(), 0.);
      std::vector<double> result(sizes);
      for (const auto &t : surface.triangles)
        for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int a = t[i], b = t[(i + 1) % 3];
            const bool         fixed
              = kinds[a] == geometry::PointKind::corner && kinds[b] == geometry::PointKind::corner;
            const double length = fixed ? surface.points[a].distance(surface.points[b]) : no_limit;
            longest[a]          = std::max(longest[a], length);
            longest[b]          = std::max(longest[b], length);
          }
      for (std::size_t p = 0; p < result.size(); ++p)
        if (longest[p] > 0.)
          result[p] = std::min(result[p], longest[p]);
      return result;
    }

    /** Keeps the ends of a kept place, and of the vertices in between as many as there is room for.
     */
    void
    keep_vertices(const TetMesh     &mesh,
                  const KeptPlace   &place,
                  std::vector<bool> &keep,
                  Thinning          &thinning)
    {
      const auto vertices = vertices_of(mesh, place);
      const auto choose   = [&](const unsigned int v) {
        if (!keep[v])
          thinning.choose(v);
        keep[v] = true;
      };
      choose(vertices.front());
      choose(vertices.back());
      for (const unsigned int v : vertices)
        if (!thinning.is_blocked(v))
          choose(v);
    }

    /** Points and lines are put in as into the first body; new points have the sizes of the old
     * mesh there. */
    void
    add_kept_places(const TetMesh &mesh, const std::vector<double> &sizes, BodyComplex &body)
    {
      if (mesh.kept.empty())
        return;
      body.plc = with_kept_places(body.plc, mesh.kept);
      for (std::size_t i = body.sizing.node_sizes.size(); i < body.plc.points.size(); ++i)
        {
          unsigned int nearest = 0;
          for (unsigned int p = 1; p < mesh.n_points(); ++p)
            if (mesh.points[p].distance_square(body.plc.points[i])
                < mesh.points[nearest].distance_square(body.plc.points[i]))
              nearest = p;
          body.sizing.node_sizes.push_back(sizes[nearest]);
        }
    }

    /** Which points stay. */
    std::vector<bool>
    chosen_points(const TetMesh                          &mesh,
                  const std::vector<double>              &sizes,
                  const EdgeTable                        &edges,
                  const std::vector<geometry::PointKind> &kinds)
    {
      using Kind = geometry::PointKind;
      Thinning          thinning(mesh, sizes, edges);
      std::vector<bool> keep(mesh.n_points(), false);
      for (const KeptPlace &place : mesh.kept)
        keep_vertices(mesh, place, keep, thinning);
      for (const Kind kind : {Kind::corner, Kind::line, Kind::flat, Kind::unused})
        for (unsigned int p = 0; p < mesh.n_points(); ++p)
          if (kinds[p] == kind && !keep[p] && (kind == Kind::corner || !thinning.is_blocked(p)))
            {
              keep[p] = true;
              thinning.choose(p);
            }
      return keep;
    }
  } // namespace

  BodyComplex
  body_complex(const TetMesh &mesh, const std::vector<double> &wanted, const EdgeTable &edges)
  {
    BodyComplex body;
    auto       &plc = body.plc;
    plc.name        = "the body";
    plc.patches     = mesh.patches;
    std::vector<std::array<unsigned int, 4>> neighbors;
    if (std::any_of(mesh.regions.begin(), mesh.regions.end(), [](int region) {
          return region != 0;
        }))
      {
        neighbors = cell_neighbors(mesh);
        add_seeds(mesh, neighbors, plc);
      }
    const auto                all = boundary_and_walls(mesh, neighbors);
    const geometry::FlatParts parts(all);
    const auto                sizes   = possible_sizes(all, parts.point_kinds(), wanted);
    const auto                keep    = chosen_points(mesh, sizes, edges, parts.point_kinds());
    const auto                surface = parts.triangulate(keep);

    std::vector<unsigned int> number(mesh.n_points(), none);
    for (unsigned int p = 0; p < mesh.n_points(); ++p)
      if (keep[p])
        {
          number[p] = plc.points.size();
          plc.points.push_back(mesh.points[p]);
          body.sizing.node_sizes.push_back(sizes[p]);
        }
    plc.facets.reserve(surface.triangles.size());
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
      {
        const auto        &v     = surface.triangles[t];
        const unsigned int patch = surface.ids[t];
        plc.facets.push_back({{number[v[0]], number[v[1]], number[v[2]]},
                              patch < mesh.patches.size() ? patch : PiecewiseLinearComplex::inner});
      }
    add_kept_places(mesh, sizes, body);
    return body;
  }
} // namespace tetradapt::mesh

// SPDX-License-Identifier: AGPL-3.0-or-later
#include "curved_volume.h"

#include <algorithm>
#include <map>

namespace tetradapt::mesh
{
  namespace
  {
    /** Cosine of the angle up to which two flat faces lie in one plane. */
    constexpr double one_plane = 1. - 1e-10;

    /** Corners of the triangles that all faces are cut into are not more, about. */
    constexpr std::size_t most_points = 30000;

    /** What a part of the boundary has to stay on. */
    struct Place
    {
      std::vector<const CurvedSurface *> surfaces;
      std::vector<Tensor<1, 3>>          planes;

      void
      add(const CurvedSurface *surface, const Tensor<1, 3> &normal)
      {
        if (surface != nullptr)
          {
            if (std::find(surfaces.begin(), surfaces.end(), surface) == surfaces.end())
              surfaces.push_back(surface);
          }
        else if (std::none_of(planes.begin(), planes.end(), [&](const Tensor<1, 3> &n) {
                   return n * normal > one_plane;
                 }))
          planes.push_back(normal);
      }
    };

    using Edge = std::pair<unsigned int, unsigned int>;

    Edge
    edge_of(const unsigned int a, const unsigned int b)
    {
      return {std::min(a, b), std::max(a, b)};
    }

    /** The boundary of a mesh cut finely, on the surfaces it belongs to. */
    class FineBoundary
    {
    public:
      FineBoundary(const TetMesh                            &mesh,
                   const std::vector<const CurvedSurface *> &surface_of_patch,
                   const unsigned int                        n)
        : mesh(mesh), surface_of_patch(surface_of_patch), n(n)
      {
        for (const BoundaryFace &face : mesh.faces)
          {
            Tensor<1, 3> normal = face_area_vector(mesh, face);
            normal /= normal.norm();
            for (unsigned int i = 0; i < 3; ++i)
              {
                const unsigned int a = face.vertices[i], b = face.vertices[(i + 1) % 3];
                vertices[a].add(surface_of_patch[face.patch], normal);
                edges[edge_of(a, b)].add(surface_of_patch[face.patch], normal);
              }
          }
      }

      bool
      is_complete() const
      {
        return complete;
      }

      /** The volume inside the triangles of @p step intervals each, for the steps given: those
       * whose corners are every step-th of the points. */
      std::vector<double>
      volumes(const std::vector<unsigned int> &steps)
      {
        const Point<3>      origin = mesh.points[mesh.faces.front().vertices[0]];
        std::vector<double> result(steps.size(), 0.);
        for (const BoundaryFace &face : mesh.faces)
          {
            const auto points = lattice(face);
            for (unsigned int s = 0; s < steps.size(); ++s)
              result[s] += cone_volume(points, steps[s], origin);
          }
        return result;
      }

    private:
      /** Number of the lattice point (i, j) of a face, i + j <= n. */
      unsigned int
      number(const unsigned int i, const unsigned int j) const
      {
        return j * (n + 1) - j * (j - 1) / 2 + i;
      }

      std::vector<Point<3>>
      lattice(const BoundaryFace &face)
      {
        const Point<3> &a = mesh.points[face.vertices[0]], &b = mesh.points[face.vertices[1]],
                       &c            = mesh.points[face.vertices[2]];
        const double          length = std::max({a.distance(b), b.distance(c), c.distance(a)});
        std::vector<Point<3>> points;
        for (unsigned int j = 0; j <= n; ++j)
          for (unsigned int i = 0; i + j <= n; ++i)
            {
              const unsigned int k = n - i - j;
              // Summed in the order of the vertices, so that neighbours get the same points.
              std::array<std::pair<unsigned int, unsigned int>, 3> parts{
                {{face.vertices[0], k}, {face.vertices[1], i}, {face.vertices[2], j}}};
              std::sort(parts.begin(), parts.end());
              Point<3> x;
              for (const auto &[v, part] : parts)
                x += static_cast<double>(part) / n * Tensor<1, 3>(mesh.points[v]);
              points.push_back(on_surface(x, place_of(face, i, j, k), length));
            }
        return points;
      }

      Place
      place_of(const BoundaryFace &face,
               const unsigned int  i,
               const unsigned int  j,
               const unsigned int  k) const
      {
        const std::array<unsigned int, 3> parts{{k, i, j}};
        for (unsigned int v = 0; v < 3; ++v)
          if (parts[v] == n)
            return vertices.at(face.vertices[v]);
        for (unsigned int v = 0; v < 3; ++v)
          if (parts[v] == 0)
            return edges.at(edge_of(face.vertices[(v + 1) % 3], face.vertices[(v + 2) % 3]));
        Place place;
        place.add(surface_of_patch[face.patch], Tensor<1, 3>());
        return place;
      }

      Point<3>
      on_surface(const Point<3> &x, const Place &place, const double length)
      {
        if (place.surfaces.empty())
          return x;
        const auto foot = find_foot(x, place.surfaces, place.planes, length);
        if (!foot)
          complete = false;
        return foot.value_or(x);
      }

      /** Volume of the cone from @p origin to the triangles of every @p step-th point. */
      double
      cone_volume(const std::vector<Point<3>> &points,
                  const unsigned int           step,
                  const Point<3>              &origin) const
      {
        double     sum = 0.;
        const auto add = [&](const unsigned int a, const unsigned int b, const unsigned int c) {
          sum
            += (points[a] - origin) * cross_product_3d(points[b] - origin, points[c] - origin) / 6.;
        };
        for (unsigned int j = 0; j < n; j += step)
          for (unsigned int i = 0; i + j < n; i += step)
            {
              add(number(i, j), number(i + step, j), number(i, j + step));
              if (i + j + step < n)
                add(number(i + step, j), number(i + step, j + step), number(i, j + step));
            }
        return sum;
      }

      const TetMesh                            &mesh;
      const std::vector<const CurvedSurface *> &surface_of_patch;
      unsigned int                              n;
      std::map<unsigned int, Place>             vertices;
      std::map<Edge, Place>                     edges;
      bool                                      complete = true;
    };
  } // namespace

  double
  curved_volume(const TetMesh &mesh, const std::vector<const CurvedSurface *> &surface_of_patch)
  {
    unsigned int n = 8;
    while (n > 2 && n * n / 2 * mesh.faces.size() > most_points)
      n /= 2;
    std::vector<unsigned int> steps;
    for (unsigned int step = std::min(n, 4u); step > 0; step /= 2)
      steps.push_back(step);
    FineBoundary        boundary(mesh, surface_of_patch, n);
    std::vector<double> table = boundary.volumes(steps);
    if (!boundary.is_complete())
      return 0.;
    // The error is a series in even powers of the triangles' size.
    double power = 4.;
    for (; table.size() > 1; power *= 4.)
      {
        for (unsigned int i = 0; i + 1 < table.size(); ++i)
          table[i] = table[i + 1] + (table[i + 1] - table[i]) / (power - 1.);
        table.pop_back();
      }
    return table[0];
  }
} // namespace tetradapt::mesh

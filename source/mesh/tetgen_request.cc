// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/tetgen_request.h"

#include "tetradapt/mesh/face_table.h"
#include "tetradapt/mesh/kept_places.h"

#include <deal.II/base/types.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>

namespace tetradapt::mesh
{
  namespace
  {
    /** Faces that meet at less than this angle (radians) lie in one plane, if their
     * coordinates are exact. */
    constexpr double flat_angle = 1e-8;

    /** Faces that meet at more than this angle do not, whatever the rounding. */
    constexpr double bent_angle = 1e-3;

    /** By how many roundings of the largest coordinate a point may miss its plane. */
    constexpr double roundings = 4.;

    /** A new mesh's facets at more than this angle (degrees) become one plane: the
     * facets of a flat wall in single precision do, while TetGen's own value, 179.9,
     * changes the volume of curved surfaces by 1e-6. */
    constexpr char merged_facets[] = "p179.99";

    /** TetGen's own tolerance for points on a straight line (-T). */
    constexpr double straight_line = 1e-8;

    /** An edge of a triangle in the request's list of faces. */
    struct FaceEdge
    {
      std::int32_t first, second; ///< point numbers, smaller first
      std::int32_t opposite;      ///< third point of the triangle
      std::int32_t marker;

      bool
      operator<(const FaceEdge &other) const
      {
        return first != other.first ? first < other.first : second < other.second;
      }
    };

    std::vector<double>
    flatten(const std::vector<Point<3>> &points)
    {
      std::vector<double> values;
      values.reserve(3 * points.size());
      for (const auto &p : points)
        for (unsigned int d = 0; d < 3; ++d)
          values.push_back(p[d]);
      return values;
    }

    std::vector<double>
    scaled_sizes(const std::vector<double> &node_sizes)
    {
      std::vector<double> sizes(node_sizes);
      for (double &size : sizes)
        size *= tetgen_size_factor;
      return sizes;
    }

    /** Whether two faces that share the edge a-b lie in one plane.
     *
     * @param rounding by how much coordinates may be off: where it is large compared with the
     *        faces, as in a body far from the origin, a flat wall looks bent. */
    bool
    is_flat(const Point<3> &a,
            const Point<3> &b,
            const Point<3> &c,
            const Point<3> &d,
            const double    rounding)
    {
      const Tensor<1, 3> edge  = (b - a) / (b - a).norm();
      const Tensor<1, 3> left  = (c - a) - ((c - a) * edge) * edge;
      const Tensor<1, 3> right = (d - a) - ((d - a) * edge) * edge;
      const double bend = std::atan2(dealii::cross_product_3d(left, right).norm(), -(left * right));
      return bend
             < std::min(bent_angle, flat_angle + rounding * (1. / left.norm() + 1. / right.norm()));
    }

    /** Rounding of the largest coordinate, times roundings. */
    double
    rounding_of(const TetMesh &mesh)
    {
      double largest = 0.;
      for (const auto &point : mesh.points)
        for (unsigned int d = 0; d < 3; ++d)
          largest = std::max(largest, std::abs(point[d]));
      return roundings * std::numeric_limits<double>::epsilon() * largest;
    }

    void
    add_faces(TetgenRequest &request, const TetMesh &mesh)
    {
      request.faces.reserve(3 * mesh.faces.size());
      request.face_markers.reserve(mesh.faces.size());
      for (const auto &face : mesh.faces)
        {
          request.faces.insert(request.faces.end(), face.vertices.begin(), face.vertices.end());
          request.face_markers.push_back(face.patch + 1);
        }
      const auto differs = [&](int region) { return region != mesh.regions.front(); };
      if (std::none_of(mesh.regions.begin(), mesh.regions.end(), differs))
        return;
      const auto neighbors = cell_neighbors(mesh);
      for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
        for (unsigned int f = 0; f < 4; ++f)
          {
            const unsigned int other = neighbors[cell][f];
            if (other == dealii::numbers::invalid_unsigned_int || other < cell
                || mesh.regions[other] == mesh.regions[cell])
              continue;
            for (const unsigned int v : face_vertices[f])
              request.faces.push_back(mesh.cells[cell][v]);
            request.face_markers.push_back(mesh.patches.size() + 1);
          }
    }

    /** All edges of the request's faces, equal ones together. */
    std::vector<FaceEdge>
    sorted_edges(const TetgenRequest &request)
    {
      std::vector<FaceEdge> edges;
      edges.reserve(request.faces.size());
      for (std::size_t f = 0; f < request.face_markers.size(); ++f)
        for (unsigned int i = 0; i < 3; ++i)
          {
            const std::int32_t a = request.faces[3 * f + i];
            const std::int32_t b = request.faces[3 * f + (i + 1) % 3];
            edges.push_back({std::min(a, b),
                             std::max(a, b),
                             request.faces[3 * f + (i + 2) % 3],
                             request.face_markers[f]});
          }
      std::sort(edges.begin(), edges.end());
      return edges;
    }

    void
    add_segments(TetgenRequest &request, const TetMesh &mesh)
    {
      const auto   edges    = sorted_edges(request);
      const double rounding = rounding_of(mesh);
      for (std::size_t i = 0, next; i < edges.size(); i = next)
        {
          next = i + 1;
          while (next < edges.size() && !(edges[i] < edges[next]))
            ++next;
          if (next == i + 2 && edges[i].marker == edges[i + 1].marker
              && is_flat(mesh.points[edges[i].first],
                         mesh.points[edges[i].second],
                         mesh.points[edges[i].opposite],
                         mesh.points[edges[i + 1].opposite],
                         rounding))
            continue;
          request.edges.push_back(edges[i].first);
          request.edges.push_back(edges[i].second);
        }
    }

    /** The edges of kept lines, each once: TetGen does not look for repetitions. */
    void
    add_kept_lines(TetgenRequest &request, const TetMesh &mesh)
    {
      if (std::none_of(mesh.kept.begin(), mesh.kept.end(), [](const KeptPlace &place) {
            return place.is_line();
          }))
        return;
      std::set<std::pair<std::int32_t, std::int32_t>> known;
      for (std::size_t i = 0; i < request.edges.size(); i += 2)
        known.insert(std::minmax(request.edges[i], request.edges[i + 1]));
      for (const KeptPlace &place : mesh.kept)
        {
          const auto vertices = vertices_of(mesh, place);
          for (std::size_t i = 1; i < vertices.size(); ++i)
            {
              const std::int32_t a = vertices[i - 1], b = vertices[i];
              if (known.insert({std::min(a, b), std::max(a, b)}).second)
                request.edges.insert(request.edges.end(), {a, b});
            }
        }
    }

    /** As the end of TetGen's reconstructmesh(): points inside the volume, inside a
     * facet, or inside a straight line of two segments. */
    unsigned long
    count_inserted(const TetgenRequest &request, const TetMesh &mesh)
    {
      std::vector<std::array<unsigned int, 2>> ends(mesh.n_points());
      std::vector<unsigned char>               n_segments(mesh.n_points(), 0);
      for (std::size_t i = 0; i < request.edges.size(); ++i)
        {
          const unsigned int v = request.edges[i];
          if (n_segments[v] < 2)
            ends[v][n_segments[v]] = request.edges[i ^ 1U];
          n_segments[v] = std::min(n_segments[v] + 1, 3);
        }
      unsigned long count = 0;
      for (unsigned int v = 0; v < mesh.n_points(); ++v)
        {
          if (n_segments[v] == 0)
            ++count;
          if (n_segments[v] != 2)
            continue;
          const auto &p = mesh.points[v], &a = mesh.points[ends[v][0]],
                     &b      = mesh.points[ends[v][1]];
          const double whole = a.distance(b);
          if ((a.distance(p) + p.distance(b) - whole) / whole < straight_line)
            ++count;
        }
      return count;
    }

    /** Bounds a cell; empty if none is asked for. */
    std::vector<double>
    volume_bounds(const TetMesh &mesh, const Sizing &sizing)
    {
      std::vector<double> bounds(sizing.cell_volumes);
      if (sizing.max_volume > 0.)
        {
          bounds.resize(mesh.n_cells(), 0.);
          for (double &bound : bounds)
            if (bound <= 0. || bound > sizing.max_volume)
              bound = sizing.max_volume;
        }
      return bounds;
    }
  } // namespace

  TetgenRequest
  make_request(const PiecewiseLinearComplex &plc, const Sizing &sizing)
  {
    TetgenRequest request;
    request.points      = flatten(plc.points);
    request.point_sizes = scaled_sizes(sizing.node_sizes);
    for (const auto &facet : plc.facets)
      {
        request.facet_offsets.push_back(request.facet_vertices.size());
        request.facet_vertices.insert(request.facet_vertices.end(),
                                      facet.vertices.begin(),
                                      facet.vertices.end());
        // Inner facets get the marker one past the last patch's, as when refining.
        request.facet_markers.push_back(
          (facet.patch == plc.inner ? plc.patches.size() : facet.patch) + 1);
      }
    request.facet_offsets.push_back(request.facet_vertices.size());
    // Lines may overlap; TetGen does not look for repetitions.
    std::set<std::pair<unsigned int, unsigned int>> segments;
    for (const auto &segment : plc.segments)
      segments.insert(std::minmax(segment[0], segment[1]));
    for (const auto &[first, second] : segments)
      {
        request.edges.push_back(first);
        request.edges.push_back(second);
      }
    for (const auto &region : plc.regions)
      request.regions.insert(request.regions.end(),
                             {region.seed[0],
                              region.seed[1],
                              region.seed[2],
                              static_cast<double>(region.id),
                              -1.}); // the bound on volumes goes into the switches
    return request;
  }

  TetgenRequest
  make_request(const TetMesh &mesh, const Sizing &sizing, unsigned long &n_inserted)
  {
    TetgenRequest request;
    request.points      = flatten(mesh.points);
    request.point_sizes = scaled_sizes(sizing.node_sizes);
    request.tet_volumes = volume_bounds(mesh, sizing);
    request.tets.reserve(4 * mesh.cells.size());
    for (const auto &cell : mesh.cells)
      request.tets.insert(request.tets.end(), cell.begin(), cell.end());
    request.tet_attributes.assign(mesh.regions.begin(), mesh.regions.end());
    add_faces(request, mesh);
    add_segments(request, mesh);
    add_kept_lines(request, mesh);
    n_inserted = count_inserted(request, mesh);
    return request;
  }

  std::string
  make_switches(const scene::TetgenParameters &parameters,
                const TetgenRequest           &request,
                double                         max_volume,
                long                           cap)
  {
    const bool refines = !request.tets.empty();
    char       text[200];
    std::snprintf(text,
                  sizeof(text),
                  "%sq%.6f/%.6fO%u/%uQ",
                  refines ? "r" : merged_facets,
                  parameters.radius_edge_ratio,
                  parameters.dihedral_angle,
                  std::min(parameters.optimisation_level, 9U), // one digit
                  parameters.optimisation_scheme);
    std::string switches = text;
    if (!request.point_sizes.empty())
      switches += 'm';
    if (!request.tet_volumes.empty())
      switches += 'a';
    if (max_volume > 0.)
      {
        std::snprintf(text, sizeof(text), "a%.17g", max_volume);
        switches += text;
      }
    if (!request.regions.empty())
      switches += 'A';
    if (parameters.keep_boundary)
      switches += 'Y';
    if (cap >= 0)
      switches += 'S' + std::to_string(cap);
    return switches;
  }
} // namespace tetradapt::mesh

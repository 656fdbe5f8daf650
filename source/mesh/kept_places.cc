// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/kept_places.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/finalize.h"

#include <algorithm>
#include <set>
#include <sstream>

namespace tetradapt::mesh
{
  namespace
  {
    /** A straight line between the ends of a kept place. */
    struct Line
    {
      Point<3>     from;
      Tensor<1, 3> along; ///< of length 1
      double       length;

      explicit Line(const std::vector<Point<3>> &ends)
        : from(ends[0]), along(ends[1] - ends[0]), length(along.norm())
      {
        along /= length;
      }

      double
      position(const Point<3> &point) const
      {
        return (point - from) * along;
      }
      double
      distance(const Point<3> &point) const
      {
        return point.distance(from + std::clamp(position(point), 0., length) * along);
      }
    };

    unsigned int
    nearest_vertex(const TetMesh &mesh, const Point<3> &point)
    {
      unsigned int nearest = 0;
      for (unsigned int p = 1; p < mesh.n_points(); ++p)
        if (mesh.points[p].distance_square(point) < mesh.points[nearest].distance_square(point))
          nearest = p;
      return nearest;
    }

    std::set<std::pair<unsigned int, unsigned int>>
    edges_between(const TetMesh &mesh, const std::vector<unsigned int> &vertices)
    {
      std::vector<bool> wanted(mesh.n_points(), false);
      for (const unsigned int v : vertices)
        wanted[v] = true;
      std::set<std::pair<unsigned int, unsigned int>> edges;
      for (const auto &cell : mesh.cells)
        for (unsigned int i = 0; i < 4; ++i)
          for (unsigned int j = 0; j < i; ++j)
            if (wanted[cell[i]] && wanted[cell[j]])
              edges.insert({std::min(cell[i], cell[j]), std::max(cell[i], cell[j])});
      return edges;
    }

    /** What vertices_of() finds; @p gap says where a line has no edge. */
    std::vector<unsigned int>
    find_vertices(const TetMesh           &mesh,
                  const KeptPlace         &place,
                  const double             tolerance,
                  std::optional<Point<3>> &gap)
    {
      std::vector<unsigned int> vertices;
      if (!place.is_line())
        {
          const unsigned int nearest = nearest_vertex(mesh, place.ends.front());
          if (mesh.points[nearest].distance(place.ends.front()) > tolerance)
            gap = place.ends.front();
          return {nearest};
        }
      const Line line(place.ends);
      for (unsigned int p = 0; p < mesh.n_points(); ++p)
        if (line.distance(mesh.points[p]) <= tolerance)
          vertices.push_back(p);
      std::sort(vertices.begin(), vertices.end(), [&](const auto p, const auto q) {
        return line.position(mesh.points[p]) < line.position(mesh.points[q]);
      });
      const auto edges = edges_between(mesh, vertices);
      for (std::size_t i = 1; i < vertices.size(); ++i)
        if (edges.count(std::minmax(vertices[i - 1], vertices[i])) == 0)
          gap = mesh.points[vertices[i - 1]]
                + .5 * (mesh.points[vertices[i]] - mesh.points[vertices[i - 1]]);
      for (const bool first : {true, false})
        if (const Point<3> &end = first ? place.ends[0] : place.ends[1];
            vertices.empty()
            || mesh.points[first ? vertices.front() : vertices.back()].distance(end) > tolerance)
          gap = end;
      return vertices;
    }

    double
    tolerance_of(const TetMesh &mesh)
    {
      const auto [lower, upper] = bounding_box(mesh);
      double extent             = 0.;
      for (unsigned int d = 0; d < 3; ++d)
        extent = std::max(extent, upper[d] - lower[d]);
      return 1e-6 * extent;
    }

    std::string
    number(const double value)
    {
      std::ostringstream text;
      text.precision(4);
      text << value;
      return text.str();
    }
  } // namespace

  std::vector<KeptPlace>
  kept_places(const scene::Scene &scene)
  {
    std::vector<KeptPlace> places;
    const auto             add = [&](const std::string &name, const scene::PlaceParameters &place) {
      if (place.point)
        places.push_back({name, {*place.point}});
      if (place.line)
        places.push_back({name, {place.line->first, place.line->second}});
    };
    for (const auto &support : scene.supports)
      add("Supports/" + support.name, support.place);
    for (const auto &load : scene.loads)
      add("Loads/" + load.name, load.place);
    return places;
  }

  std::vector<KeptPlace>
  places_on_vertices(const TetMesh &mesh, const std::vector<KeptPlace> &places)
  {
    const double           tolerance = tolerance_of(mesh);
    std::vector<KeptPlace> result;
    for (const KeptPlace &wanted : places)
      {
        KeptPlace found = wanted;
        for (Point<3> &end : found.ends)
          {
            const Point<3> &nearest  = mesh.points[nearest_vertex(mesh, end)];
            const double    distance = nearest.distance(end);
            if (distance > tolerance)
              throw core::InputError(
                wanted.name + (wanted.is_line() ? "/Line: " : "/Point: ")
                + "there is no vertex of the mesh at " + to_string(end) + ". The nearest one is "
                + to_string(nearest) + ", at a distance of " + number(distance)
                + ". Points are not put into this mesh: take a vertex, or Mesh/Type = box, blocks "
                  "or surface.");
            end = nearest;
          }
        std::optional<Point<3>> gap;
        if (found.is_line())
          find_vertices(mesh, found, tolerance, gap);
        if (gap)
          throw core::InputError(wanted.name + "/Line: no edge of the mesh runs along it at "
                                 + to_string(*gap)
                                 + ". Lines are not put into this mesh: take one that edges follow "
                                   "all the way, or Mesh/Type = box, blocks or surface.");
        result.push_back(found);
      }
    return result;
  }

  std::vector<unsigned int>
  vertices_of(const TetMesh &mesh, const KeptPlace &place)
  {
    std::optional<Point<3>> gap;
    const auto              vertices = find_vertices(mesh, place, tolerance_of(mesh), gap);
    if (gap)
      throw core::NumericalError(
        place.name + ": the mesh has no " + (place.is_line() ? "edge" : "vertex") + " at "
        + to_string(*gap)
        + ", where one must be kept. Change the wanted size or TetGen's quality bounds slightly.");
    return vertices;
  }

  const KeptPlace *
  find_place(const TetMesh &mesh, const std::string &name)
  {
    for (const KeptPlace &place : mesh.kept)
      if (place.name == name)
        return &place;
    return nullptr;
  }

  void
  check_kept_places(const TetMesh &mesh)
  {
    for (const KeptPlace &place : mesh.kept)
      vertices_of(mesh, place);
  }
} // namespace tetradapt::mesh

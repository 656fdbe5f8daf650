// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/excluded_region.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/kept_places.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetradapt::compare
{
  namespace
  {
    double
    largest_extent(const mesh::TetMesh &mesh)
    {
      const auto [lower, upper] = mesh::bounding_box(mesh);
      double extent             = 0.;
      for (unsigned int d = 0; d < 3; ++d)
        extent = std::max(extent, upper[d] - lower[d]);
      return extent;
    }

    /** Six digits, and 0 for what rounding left of it. */
    std::string
    short_text(const Point<3> &point)
    {
      std::ostringstream text;
      for (unsigned int d = 0; d < 3; ++d)
        text << (d == 0 ? "(" : ", ")
             << (std::abs(point[d]) < 1e-12 * point.norm() ? 0. : point[d]);
      return text.str() + ")";
    }

    Point<3>
    centroid(const mesh::TetMesh &mesh, const unsigned int cell)
    {
      Point<3> sum;
      for (const unsigned int v : mesh.cells[cell])
        sum += mesh.points[v];
      return sum / 4.;
    }
  } // namespace

  bool
  ExcludedRegion::Part::contains(const Point<3> &point) const
  {
    const dealii::Tensor<1, 3> along  = ends[1] - ends[0];
    const double               length = along.norm_square();
    const double t = length > 0. ? std::clamp((point - ends[0]) * along / length, 0., 1.) : 0.;
    return point.distance(ends[0] + t * along) < radius;
  }

  std::string
  ExcludedRegion::Part::text() const
  {
    std::ostringstream text;
    text.precision(4);
    text << "within " << radius << " of ";
    if (ends[0] == ends[1])
      text << short_text(ends[0]);
    else
      text << "the line from " << short_text(ends[0]) << " to " << short_text(ends[1]);
    return text.str();
  }

  ExcludedRegion::ExcludedRegion(const scene::Scene &scene, const mesh::TetMesh &mesh)
  {
    if (mesh.kept.empty())
      return;
    const double default_radius = scene::PlaceParameters::default_radius * largest_extent(mesh);
    const auto   add
      = [&](const std::string &name, const scene::PlaceParameters &place, const bool is_force) {
          if (const mesh::KeptPlace *kept = mesh::find_place(mesh, name))
            parts.push_back({name,
                             {{kept->ends.front(), kept->ends.back()}},
                             place.excluded_radius.value_or(default_radius),
                             is_force});
        };
    for (const auto &support : scene.supports)
      add("Supports/" + support.name, support.place, false);
    for (const auto &load : scene.loads)
      add("Loads/" + load.name, load.place, true);
  }

  bool
  ExcludedRegion::empty() const
  {
    return std::none_of(parts.begin(), parts.end(), [](const Part &p) { return p.radius > 0.; });
  }

  bool
  ExcludedRegion::contains(const Point<3> &point) const
  {
    return std::any_of(parts.begin(), parts.end(), [&](const Part &p) {
      return p.contains(point);
    });
  }

  unsigned int
  ExcludedRegion::part_of(const mesh::TetMesh &mesh, const unsigned int cell) const
  {
    const Point<3> middle = centroid(mesh, cell);
    unsigned int   part   = 0;
    while (part < parts.size() && !parts[part].contains(middle))
      ++part;
    return part;
  }

  std::vector<bool>
  ExcludedRegion::cells(const mesh::TetMesh &mesh) const
  {
    std::vector<bool> result(mesh.n_cells(), false);
    if (empty())
      return result;
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      result[cell] = part_of(mesh, cell) < parts.size();
    if (std::find(result.begin(), result.end(), false) == result.end())
      {
        const auto largest
          = std::max_element(parts.begin(), parts.end(), [](const Part &a, const Part &b) {
              return a.radius < b.radius;
            });
        throw core::InputError(largest->name + "/Excluded radius: errors leave out what is "
                               + largest->text()
                               + ", and with that every tetrahedron. Make the radius smaller.");
      }
    return result;
  }

  void
  ExcludedRegion::clear(const mesh::TetMesh &mesh, std::vector<double> &cell_values) const
  {
    if (empty())
      return;
    const std::vector<bool> excluded = cells(mesh);
    for (unsigned int cell = 0; cell < cell_values.size(); ++cell)
      if (excluded[cell])
        cell_values[cell] = 0.;
  }

  void
  ExcludedRegion::continue_into(const mesh::TetMesh &mesh, std::vector<double> &indicators) const
  {
    if (empty() || indicators.empty())
      return;
    const unsigned int        outside = parts.size();
    std::vector<unsigned int> part(mesh.n_cells());
    // Per part, which points its cells have.
    std::vector<std::vector<bool>> touched(outside, std::vector<bool>(mesh.n_points(), false));
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      {
        part[cell] = part_of(mesh, cell);
        if (part[cell] < outside)
          for (const unsigned int v : mesh.cells[cell])
            touched[part[cell]][v] = true;
      }
    std::vector<double> squares(outside, 0.), volumes(outside, 0.);
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      if (part[cell] == outside)
        for (unsigned int p = 0; p < outside; ++p)
          if (std::any_of(mesh.cells[cell].begin(), mesh.cells[cell].end(), [&](const auto v) {
                return touched[p][v];
              }))
            {
              squares[p] += indicators[cell] * indicators[cell];
              volumes[p] += mesh::cell_volume(mesh, cell);
            }
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      if (const unsigned int p = part[cell]; p < outside)
        indicators[cell] = volumes[p] > 0.
                             ? std::sqrt(squares[p] / volumes[p] * mesh::cell_volume(mesh, cell))
                             : 0.;
  }
} // namespace tetradapt::compare

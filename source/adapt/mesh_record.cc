// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/mesh_record.h"

#include "tetradapt/adapt/size_field.h"
#include "tetradapt/mesh/quality.h"
#include "tetradapt/mesh/space_curve.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace tetradapt::adapt
{
  namespace
  {
    /** Class of MeshRecord::dihedral_histogram. */
    unsigned int
    dihedral_class(double angle)
    {
      constexpr std::array<double, 7> ends{{5., 10., 20., 30., 40., 50., 60.}};
      return std::upper_bound(ends.begin(), ends.end(), angle) - ends.begin();
    }

    struct Named
    {
      std::string   name;
      unsigned long count = 0;
    };

    std::string
    list(const std::string &what, const std::map<int, Named> &entries)
    {
      std::string text;
      for (const auto &[id, entry] : entries)
        text += (text.empty() ? "" : ", ") + what + ' ' + std::to_string(id)
                + (entry.name.empty() ? "" : " (" + entry.name + ")") + ": "
                + std::to_string(entry.count);
      return text;
    }

    /** Faces by boundary id and cells by region. */
    std::string
    counts_line(const mesh::TetMesh &mesh)
    {
      std::map<int, Named> ids, regions;
      for (const mesh::Patch &patch : mesh.patches)
        ids[patch.boundary_id].name = patch.name;
      for (const mesh::BoundaryFace &face : mesh.faces)
        ++ids[mesh.patches[face.patch].boundary_id].count;
      Named *entry = nullptr;
      int    last  = 0;
      for (const int region : mesh.regions)
        {
          if (entry == nullptr || region != last)
            entry = &regions[last = region];
          ++entry->count;
        }
      for (auto &[id, region] : regions)
        if (const auto name = mesh.region_names.find(id); name != mesh.region_names.end())
          region.name = name->second;
      return "faces of " + list("id", ids) + "; cells of " + list("region", regions);
    }
  } // namespace

  void
  describe_mesh(const mesh::TetMesh &mesh, const double first_volume, MeshRecord &record)
  {
    double volume           = 0.;
    record.min_dihedral     = 180.;
    record.max_dihedral     = 0.;
    record.max_aspect_ratio = 0.;
    record.dihedral_histogram.fill(0);
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      {
        const mesh::CellQuality quality = mesh::cell_quality(mesh, cell);
        volume += mesh::cell_volume(mesh, cell);
        record.min_dihedral     = std::min(record.min_dihedral, quality.min_dihedral);
        record.max_dihedral     = std::max(record.max_dihedral, quality.max_dihedral);
        record.max_aspect_ratio = std::max(record.max_aspect_ratio, quality.aspect_ratio);
        ++record.dihedral_histogram[dihedral_class(quality.min_dihedral)];
      }
    record.volume       = volume;
    record.volume_drift = volume / first_volume - 1.;
    record.counts_by_id = counts_line(mesh);
  }

  void
  describe_moves(const mesh::MoveReport &moves, MeshRecord &record)
  {
    record.largest_projection = moves.farthest;
    record.unprojected_points = moves.n_held;
  }

  unsigned long
  count_oversized_tets(const mesh::TetMesh         &mesh,
                       const compare::PointLocator &locator,
                       const std::vector<double>   &node_sizes)
  {
    // In an order in which one search can start where the last one ended.
    std::vector<mesh::Point<3>> centroids(mesh.n_cells());
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      for (const unsigned int v : mesh.cells[cell])
        centroids[cell] += mesh.points[v] / 4.;
    const auto [lower, upper] = mesh::bounding_box(mesh);
    const mesh::TetMesh &old  = locator.mesh();
    unsigned long        n    = 0;
    unsigned int         hint = dealii::numbers::invalid_unsigned_int;
    for (const unsigned int cell : mesh::SpaceCurve(lower, upper).order(centroids))
      {
        const compare::Location location = locator.locate(centroids[cell], hint);
        hint                             = location.cell;
        double wanted                    = 0.;
        for (unsigned int i = 0; i < 4; ++i)
          wanted += location.barycentric[i] * node_sizes[old.cells[hint][i]];
        if (equivalent_edge(mesh::cell_volume(mesh, cell)) > 2. * wanted)
          ++n;
      }
    return n;
  }

  std::vector<double>
  obtained_sizes(const mesh::TetMesh &mesh)
  {
    std::vector<double> volumes(mesh.n_points(), 0.), sizes(mesh.n_points(), 0.);
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      {
        const double volume   = mesh::cell_volume(mesh, cell);
        const double weighted = volume * std::log(equivalent_edge(volume));
        for (const unsigned int v : mesh.cells[cell])
          {
            volumes[v] += volume;
            sizes[v] += weighted;
          }
      }
    for (unsigned int p = 0; p < mesh.n_points(); ++p)
      sizes[p] = volumes[p] > 0. ? std::exp(sizes[p] / volumes[p]) : 0.;
    return sizes;
  }
} // namespace tetradapt::adapt

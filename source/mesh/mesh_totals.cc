// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/mesh_totals.h"

#include <cmath>
#include <sstream>

namespace tetradapt::mesh
{
  MeshTotals
  mesh_totals(const TetMesh &mesh)
  {
    MeshTotals totals;
    totals.n_points = mesh.n_points();
    totals.n_cells  = mesh.n_cells();
    totals.n_faces  = mesh.faces.size();

    totals.patches.resize(mesh.patches.size());
    for (unsigned int p = 0; p < mesh.patches.size(); ++p)
      totals.patches[p].patch = mesh.patches[p];
    for (const BoundaryFace &face : mesh.faces)
      {
        MeshTotals::PatchEntry &entry = totals.patches[face.patch];
        const double            area  = face_area_vector(mesh, face).norm();
        ++entry.n_faces;
        entry.area += area;
        totals.area += area;
      }

    // Cells of one region mostly follow each other: no search a cell.
    MeshTotals::RegionEntry *entry  = nullptr;
    int                      region = 0;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        if (entry == nullptr || mesh.regions[c] != region)
          {
            region = mesh.regions[c];
            entry  = &totals.regions[region];
          }
        ++entry->n_cells;
        entry->volume += cell_volume(mesh, c);
      }
    for (auto &[id, region_entry] : totals.regions)
      {
        const auto name = mesh.region_names.find(id);
        if (name != mesh.region_names.end())
          region_entry.name = name->second;
        totals.volume += region_entry.volume;
      }
    return totals;
  }



  std::string
  describe(const Patch &patch)
  {
    std::string text = "boundary id " + std::to_string(patch.boundary_id);
    if (!patch.name.empty())
      text += " (" + patch.name + ")";
    for (unsigned int s = 0; s < patch.selections.size(); ++s)
      text += (s == 0 ? ", selected by '" : "', '") + patch.selections[s];
    return patch.selections.empty() ? text : text + "'";
  }



  namespace
  {
    /** "region 2 (muscle)" */
    std::string
    describe_region(const int id, const MeshTotals::RegionEntry &region)
    {
      return "region " + std::to_string(id) + (region.name.empty() ? "" : " (" + region.name + ")");
    }



    /** Adds a complaint if a measure changed by more than is @p allowed. */
    void
    compare_measure(const std::string        &what,
                    const double              before,
                    const double              after,
                    const double              allowed,
                    std::vector<std::string> &complaints)
    {
      if (std::abs(after - before) <= allowed)
        return;
      std::ostringstream text;
      text.precision(10);
      text << what << " changed from " << before << " to " << after;
      complaints.push_back(text.str());
    }
  } // namespace



  std::vector<std::string>
  compare_totals(const MeshTotals &before, const MeshTotals &after, const double tolerance)
  {
    std::vector<std::string> complaints;
    compare_measure(
      "the volume", before.volume, after.volume, tolerance * before.volume, complaints);

    for (const auto &[id, region] : before.regions)
      if (const auto found = after.regions.find(id); found == after.regions.end())
        complaints.push_back(describe_region(id, region) + " is lost");
      else
        compare_measure("the volume of " + describe_region(id, region),
                        region.volume,
                        found->second.volume,
                        tolerance * before.volume,
                        complaints);
    for (const auto &[id, region] : after.regions)
      if (before.regions.count(id) == 0)
        complaints.push_back(describe_region(id, region) + " is new");

    for (unsigned int p = 0; p < std::max(before.patches.size(), after.patches.size()); ++p)
      {
        const bool had = p < before.patches.size() && before.patches[p].n_faces > 0;
        const bool has = p < after.patches.size() && after.patches[p].n_faces > 0;
        if (had && !has)
          complaints.push_back("the boundary patch with " + describe(before.patches[p].patch)
                               + " is lost");
        else if (has && !had)
          complaints.push_back("the boundary patch with " + describe(after.patches[p].patch)
                               + " is new");
        else if (had)
          compare_measure("the area of the boundary patch with "
                            + describe(before.patches[p].patch),
                          before.patches[p].area,
                          after.patches[p].area,
                          tolerance * before.area,
                          complaints);
      }
    return complaints;
  }
} // namespace tetradapt::mesh

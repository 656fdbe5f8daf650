// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/left_out.h"

#include "tetradapt/compare/reference_sampling.h"

#include <sstream>

namespace tetradapt::adapt
{
  std::vector<LeftOutRecord>
  left_out_of(const compare::ExcludedRegion &excluded, const mesh::TetMesh &mesh)
  {
    std::vector<LeftOutRecord> records;
    excluded.cells(mesh); // throws
    for (const auto &part : excluded.all_parts())
      {
        LeftOutRecord record;
        record.name     = part.name;
        record.radius   = part.radius;
        record.is_force = part.is_force;
        if (part.radius > 0.)
          {
            record.place = part.text();
            for (const auto &cell : mesh.cells)
              {
                mesh::Point<3> middle;
                for (const unsigned int v : cell)
                  middle += mesh.points[v] / 4.;
                record.n_cells += part.contains(middle) ? 1 : 0;
              }
          }
        records.push_back(record);
      }
    return records;
  }

  std::vector<std::string>
  describe_left_out(const std::vector<LeftOutRecord> &left_out)
  {
    std::vector<std::string> texts;
    for (const LeftOutRecord &part : left_out)
      {
        std::string text = part.name;
        text += part.is_force
                  ? ": the energy of a force at a point does not converge there, but grows without "
                    "limit as the mesh is refined."
                  : ": where its reaction is not zero, the energy of a support at a point or on a "
                    "line does not converge, but grows without limit as the mesh is refined.";
        if (part.radius > 0.)
          text += " Errors and estimates leave out what is " + part.place + ", now "
                  + (part.n_cells > 0
                       ? std::to_string(part.n_cells)
                           + (part.n_cells == 1 ? " tetrahedron." : " tetrahedra.")
                       : "no tetrahedron: those there are larger than that, and count.");
        else if (part.is_force)
          text += " Errors and estimates leave nothing out (Excluded radius = 0).";
        else
          continue; // it is to carry nothing: see reaction_warnings()
        texts.push_back(text);
      }
    return texts;
  }

  std::vector<std::string>
  reaction_warnings(const CycleRecord &record)
  {
    constexpr double         nothing = 1e-6; // of all forces
    std::vector<std::string> texts;
    for (const LeftOutRecord &part : record.left_out)
      if (part.radius == 0. && !part.is_force && record.equilibrium)
        for (const solve::ActingForce &support : record.equilibrium->supports)
          {
            const double force = support.resultant.force.norm();
            if ("Supports/" + support.name != part.name
                || force <= nothing * record.equilibrium->force_scale)
              continue;
            std::ostringstream text;
            text.precision(3);
            text << part.name << " has a reaction of " << force
                 << ": the energy does not converge there, but errors and estimates leave nothing "
                    "out, for its Excluded radius is 0. Give it a radius, or loads in balance.";
            texts.push_back(text.str());
          }
    return texts;
  }

  mechanics::EnergyNorm
  norm_outside(estimate::Comparison &comparison, const mechanics::EnergyNorm &whole)
  {
    if (comparison.excluded_region().empty())
      return whole;
    // Shares nothing: the sampling does not outlive this call.
    const std::shared_ptr<const mesh::NodalField> borrowed(std::shared_ptr<void>(),
                                                           &comparison.displacement());
    mechanics::EnergyNorm                         norm = whole;
    norm.value                                         = compare::ReferenceSampling(borrowed,
                                            comparison.material_map(),
                                            comparison.mpi_communicator(),
                                            comparison.excluded_region())
                   .energy_norm();
    return norm;
  }
} // namespace tetradapt::adapt

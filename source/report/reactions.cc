// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/reactions.h"

#include "tetradapt/report/record_columns.h"
#include "tetradapt/report/text_lines.h"

#include <algorithm>

namespace tetradapt::report
{
  namespace
  {
    using Vector3 = dealii::Tensor<1, 3>;
    using Cells   = std::vector<std::string>;

    std::string
    figure(const double value)
    {
      return format_number(value, 10);
    }

    Cells
    figures(const Vector3 &vector)
    {
      return {figure(vector[0]), figure(vector[1]), figure(vector[2])};
    }

    void
    append(Cells &cells, const Cells &more)
    {
      cells.insert(cells.end(), more.begin(), more.end());
    }

    std::string
    csv_line(const Cells &cells)
    {
      std::string line;
      for (const std::string &cell : cells)
        line += (&cell == &cells.front() ? "" : ",") + cell;
      return line + '\n';
    }

    /** A number of acting faces or cells with what they measure; empty where there are none. */
    Cells
    amounts(const unsigned long n, const double measure)
    {
      return n == 0 ? Cells{"", ""} : Cells{std::to_string(n), figure(measure)};
    }

    Cells
    acting_cells(const std::string &cycle, const solve::ActingForce &acting)
    {
      Cells cells{cycle, csv_text(acting.kind), csv_text(acting.name)};
      append(cells, amounts(acting.extent.n_faces, acting.extent.area));
      cells.push_back(acting.extent.n_nodes == 0 ? "" : std::to_string(acting.extent.n_nodes));
      append(cells, amounts(acting.extent.n_cells, acting.extent.volume));
      append(cells, figures(acting.resultant.force));
      append(cells, figures(acting.resultant.moment));
      append(cells, {"", "", ""});
      return cells;
    }

    /** How well a load is known and how much it changed, relative to int |density|. */
    Cells
    accuracy_cells(const adapt::LoadRecord &load)
    {
      const mechanics::LoadTotal &total = load.total;
      return {total.magnitude > 0. ? figure(total.remainder / total.magnitude) : "",
              figure(load.drift)};
    }

    Cells
    imbalance_cells(const std::string &cycle, const solve::Equilibrium &equilibrium)
    {
      Cells cells{cycle, "imbalance", "", "", "", "", "", ""};
      append(cells, figures(equilibrium.imbalance.force));
      append(cells, figures(equilibrium.imbalance.moment));
      append(cells,
             {figure(equilibrium.force_scale),
              figure(equilibrium.relative_imbalance),
              figure(equilibrium.allowed_imbalance),
              "",
              ""});
      return cells;
    }

    std::string
    short_number(const double value)
    {
      return format_number(value, 5);
    }

    std::string
    extent_text(const mechanics::Extent &extent)
    {
      std::string text;
      if (extent.n_faces > 0)
        text = "area " + short_number(extent.area) + ", " + std::to_string(extent.n_faces)
               + (extent.n_faces == 1 ? " face" : " faces");
      else if (extent.n_nodes > 0)
        text = std::to_string(extent.n_nodes) + (extent.n_nodes == 1 ? " node" : " nodes");
      if (extent.n_cells > 0)
        text += (text.empty() ? "" : ", ") + std::string("volume ") + short_number(extent.volume);
      return text;
    }

    std::string
    acting_text(const solve::ActingForce &acting, const ForceNoise &noise)
    {
      const std::string extent = extent_text(acting.extent);
      return "  " + acting.name + " (" + acting.kind + (extent.empty() ? "" : ", " + extent)
             + ")\n    force " + short_vector(acting.resultant.force, noise.force) + ", moment "
             + short_vector(acting.resultant.moment, noise.moment) + '\n';
    }

  } // namespace

  ForceNoise
  force_noise(const solve::Equilibrium &equilibrium)
  {
    double moment = equilibrium.force_scale * equilibrium.lever;
    for (const auto *list : {&equilibrium.supports, &equilibrium.loads})
      for (const solve::ActingForce &acting : *list)
        moment = std::max(moment, acting.resultant.moment.norm());
    const double part = std::clamp(equilibrium.allowed_imbalance, 1e-9, 1e-6);
    return {part * equilibrium.force_scale, part * moment};
  }

  std::string
  csv_reactions(const std::vector<adapt::CycleRecord> &records)
  {
    std::string text
      = "cycle,kind,name,faces,area,nodes,tets,volume,force_x,force_y,force_z,moment_x,"
        "moment_y,moment_z,force_scale,relative_imbalance,allowed_imbalance,remainder,drift\n";
    for (const adapt::CycleRecord &record : records)
      {
        if (!record.equilibrium)
          continue;
        const std::string cycle = std::to_string(record.cycle);
        for (const solve::ActingForce &support : record.equilibrium->supports)
          {
            Cells cells = acting_cells(cycle, support);
            append(cells, {"", ""});
            text += csv_line(cells);
          }
        for (std::size_t i = 0; i < record.equilibrium->loads.size(); ++i)
          {
            Cells cells = acting_cells(cycle, record.equilibrium->loads[i]);
            append(cells,
                   i < record.loads.size() ? accuracy_cells(record.loads[i]) : Cells{"", ""});
            text += csv_line(cells);
          }
        text += csv_line(imbalance_cells(cycle, *record.equilibrium));
      }
    return text;
  }

  std::string
  csv_regions(const std::vector<adapt::CycleRecord> &records)
  {
    std::string text
      = "cycle,region,name,tets,volume,mass,max_von_mises,max_von_mises_x,max_von_mises_y,"
        "max_von_mises_z,max_displacement,max_displacement_x,max_displacement_y,"
        "max_displacement_z\n";
    for (const adapt::CycleRecord &record : records)
      for (const mechanics::RegionFigures &region : record.regions)
        {
          Cells cells{std::to_string(record.cycle),
                      std::to_string(region.region),
                      csv_text(region.name),
                      std::to_string(region.n_cells),
                      figure(region.volume),
                      figure(region.mass)};
          for (const auto *largest : {&region.von_mises, &region.displacement})
            {
              cells.push_back(figure(largest->value));
              append(cells, figures(largest->place));
            }
          text += csv_line(cells);
        }
    return text;
  }

  std::string
  text_reactions(const solve::Equilibrium &equilibrium)
  {
    const ForceNoise noise = force_noise(equilibrium);
    std::string      text  = "Reactions of supports, moments about the origin\n";
    for (const solve::ActingForce &acting : equilibrium.supports)
      text += acting_text(acting, noise);
    text += equilibrium.loads.empty() ? "No loads\n" : "Loads\n";
    for (const solve::ActingForce &acting : equilibrium.loads)
      text += acting_text(acting, noise);
    return text + "Imbalance " + format_number(equilibrium.relative_imbalance, 2)
           + " of all forces, allowed " + format_number(equilibrium.allowed_imbalance, 2) + '\n';
  }

  std::string
  text_regions(const std::vector<mechanics::RegionFigures> &regions)
  {
    std::string text;
    for (const mechanics::RegionFigures &region : regions)
      {
        text += "Region " + std::to_string(region.region)
                + (region.name.empty() ? "" : " (" + region.name + ")") + ": "
                + std::to_string(region.n_cells) + " tetrahedra, volume "
                + short_number(region.volume)
                + (region.mass > 0. ? ", mass " + short_number(region.mass) : "") + '\n';
        const auto add = [&](const std::string &name, const mechanics::LargestValue &largest) {
          text += "  largest " + name + " " + short_number(largest.value) + " at "
                  + short_vector(largest.place, 1e-9 * largest.place.norm()) + '\n';
        };
        add("displacement", region.displacement);
        add("von Mises stress", region.von_mises);
      }
    return text;
  }

  ReactionsTable::ReactionsTable(ResultFolder &folder) : folder(folder)
  {
  }

  void
  ReactionsTable::run_started(const scene::Scene &)
  {
    records.clear();
  }

  void
  ReactionsTable::cycle_done(const adapt::CycleEvent &event)
  {
    records.push_back(event.record);
    folder.write("reactions.csv", csv_reactions(records));
    folder.write("regions.csv", csv_regions(records));
  }
} // namespace tetradapt::report

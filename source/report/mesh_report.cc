// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/mesh_report.h"

#include "tetradapt/report/record_columns.h"

#include <cmath>


namespace tetradapt::report
{
  namespace
  {
    using Kind = RecordColumn::Kind;

    bool
    is_reported(const adapt::CycleRecord &record)
    {
      return record.mesh.max_dihedral > 0.;
    }

    std::string
    number(const double value)
    {
      return format_number(value, 4);
    }

    std::string
    figure(const double value)
    {
      return format_number(value, 10);
    }

    std::string
    csv_row_of(const adapt::CycleRecord &record)
    {
      const adapt::MeshRecord &mesh = record.mesh;
      std::string              line
        = std::to_string(record.cycle) + "," + std::to_string(record.points) + ","
          + std::to_string(record.tets) + ","
          + format_cell(Kind::figure, mesh.requested_tets, 10, -1, "") + ","
          + std::to_string(mesh.oversized_tets) + "," + figure(visible_drift(mesh)) + ","
          + figure(mesh.volume) + "," + (mesh.body_volume > 0. ? figure(mesh.body_volume) : "")
          + "," + std::to_string(mesh.n_parts) + "," + figure(mesh.largest_projection) + ","
          + std::to_string(mesh.unprojected_points) + "," + figure(mesh.min_dihedral) + ","
          + figure(mesh.max_dihedral) + "," + figure(mesh.max_aspect_ratio);
      for (const unsigned long count : mesh.dihedral_histogram)
        line += "," + std::to_string(count);
      return line + "," + csv_text(mesh.counts_by_id) + "\n";
    }

    std::string
    histogram_line(const adapt::MeshRecord &mesh)
    {
      unsigned long all = 0;
      for (const unsigned long count : mesh.dihedral_histogram)
        all += count;
      if (all == 0)
        return "";
      std::string text = "smallest dihedral angles";
      for (unsigned int i = 0; i < dihedral_class_begins.size(); ++i)
        {
          const unsigned int begin = dihedral_class_begins[i];
          text += (i == 0 ? " " : ", ")
                  + (i + 1 == dihedral_class_begins.size()
                       ? "from " + std::to_string(begin)
                       : std::to_string(begin) + "-" + std::to_string(dihedral_class_begins[i + 1]))
                  + ": " + number(100. * mesh.dihedral_histogram[i] / all) + " %";
        }
      return text;
    }
  } // namespace

  double
  visible_drift(const adapt::MeshRecord &mesh)
  {
    return std::abs(mesh.volume_drift) > 1e-12 ? mesh.volume_drift : 0.;
  }

  const std::array<unsigned int, 8> dihedral_class_begins{{0, 5, 10, 20, 30, 40, 50, 60}};

  std::string
  dihedral_class_name(const unsigned int number)
  {
    const auto &begins = dihedral_class_begins;
    return number + 1 == begins.size() ? "dihedral_from_" + std::to_string(begins[number])
                                       : "dihedral_" + std::to_string(begins[number]) + "_to_"
                                           + std::to_string(begins[number + 1]);
  }

  std::string
  csv_meshes(const std::vector<adapt::CycleRecord> &records)
  {
    std::string text
      = "cycle,points,tets,requested_tets,oversized_tets,volume_drift,volume,body_volume,parts,"
        "largest_projection,unprojected_points,min_dihedral,max_dihedral,max_aspect_ratio";
    for (unsigned int i = 0; i < dihedral_class_begins.size(); ++i)
      text += "," + dihedral_class_name(i);
    text += ",counts_by_id\n";
    for (const adapt::CycleRecord &record : records)
      text += csv_row_of(record);
    return text;
  }

  std::string
  describe_mesh_record(const adapt::CycleRecord &record)
  {
    if (!is_reported(record))
      return "";
    const adapt::MeshRecord &mesh = record.mesh;
    std::string              text
      = "Mesh of cycle " + std::to_string(record.cycle) + ": " + std::to_string(record.tets)
        + " tetrahedra"
        + (mesh.requested_tets ? ", " + number(*mesh.requested_tets) + " asked for" : "");
    if (mesh.requested_tets || mesh.oversized_tets > 0)
      text += ", " + std::to_string(mesh.oversized_tets) + " more than twice as large as wanted";
    text += visible_drift(mesh) != 0.
              ? ", volume changed by " + number(100. * mesh.volume_drift) + " %"
              : ", volume kept";
    if (mesh.largest_projection > 0. || mesh.unprojected_points > 0)
      text += ", points moved to the boundary by up to " + number(mesh.largest_projection) + ", "
              + std::to_string(mesh.unprojected_points)
              + " not moved, since a tetrahedron would have been inverted";
    for (const std::string &line : {histogram_line(mesh), mesh.counts_by_id})
      text += (line.empty() ? "" : "\n") + line;
    return text;
  }

  MeshReport::MeshReport(ResultFolder *folder, const core::Log &log) : folder(folder), log(log)
  {
  }

  void
  MeshReport::run_started(const scene::Scene &)
  {
    records.clear();
  }

  void
  MeshReport::cycle_done(const adapt::CycleEvent &event)
  {
    if (!is_reported(event.record))
      return;
    records.push_back(event.record);
    log.detail(describe_mesh_record(event.record));
    if (folder != nullptr)
      folder->write("mesh.csv", csv_meshes(records));
  }
} // namespace tetradapt::report

// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/vtu_series.h"

#include "tetradapt/io/vtu_writer.h"
#include "tetradapt/report/mean_stresses.h"
#include "tetradapt/report/record_columns.h"

#include <algorithm>
#include <cstdio>

namespace tetradapt::report
{
  namespace
  {
    std::string
    file_name(const unsigned int cycle)
    {
      char name[40];
      std::snprintf(name, sizeof name, "cycle_%03u.vtu", cycle);
      return name;
    }

    std::array<unsigned int, 3>
    sorted(unsigned int a, unsigned int b, unsigned int c)
    {
      if (a > b)
        std::swap(a, b);
      if (b > c)
        std::swap(b, c);
      if (a > b)
        std::swap(a, b);
      return {{a, b, c}};
    }
  } // namespace

  std::vector<int>
  surface_patches(const mesh::TetMesh &mesh)
  {
    // The boundary faces, in one bucket for each smallest point. Only boundary
    // points have one, so that most cells are passed over at once.
    struct Face
    {
      unsigned int middle, largest;
      int          patch;
    };
    std::vector<unsigned int> begin(mesh.n_points() + 2, 0);
    for (const auto &face : mesh.faces)
      ++begin[*std::min_element(face.vertices.begin(), face.vertices.end()) + 2];
    for (unsigned int i = 2; i < begin.size(); ++i)
      begin[i] += begin[i - 1];
    std::vector<Face> faces(mesh.faces.size());
    for (const auto &face : mesh.faces)
      {
        const auto v             = sorted(face.vertices[0], face.vertices[1], face.vertices[2]);
        faces[begin[v[0] + 1]++] = {v[1], v[2], int(face.patch)};
      }

    std::vector<int> patches(mesh.n_cells(), -1);
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      for (unsigned int opposite = 0; opposite < 4; ++opposite)
        {
          const auto &c = mesh.cells[cell];
          const auto  v
            = sorted(c[(opposite + 1) % 4], c[(opposite + 2) % 4], c[(opposite + 3) % 4]);
          for (unsigned int i = begin[v[0]]; i < begin[v[0] + 1]; ++i)
            if (faces[i].middle == v[1] && faces[i].largest == v[2])
              patches[cell] = std::max(patches[cell], faces[i].patch);
        }
    return patches;
  }

  VtuSeries::VtuSeries(ResultFolder &folder, const bool with_stress)
    : folder(folder), with_stress(with_stress)
  {
  }

  void
  VtuSeries::run_started(const scene::Scene &scene)
  {
    scene_name = scene.name;
    entries.clear();
  }

  void
  VtuSeries::cycle_done(const adapt::CycleEvent &event)
  {
    const std::string name = file_name(event.record.cycle);
    write_cycle(event, folder.prepare(name));
    entries.push_back({event.record.cycle, name});
    write_series();
  }

  void
  VtuSeries::write_cycle(const adapt::CycleEvent &event, const std::string &path) const
  {
    io::VtuWriter writer(*event.displacement);
    if (event.nodal_ren != nullptr)
      writer.add_point_data("REN", 1, *event.nodal_ren);
    writer.add_regions();
    writer.add_cell_ids("surface_patch", surface_patches(event.mesh));
    if (event.indicators != nullptr)
      writer.add_cell_data("error_indicator", 1, *event.indicators);
    if (with_stress)
      {
        const MeanStresses stresses = mean_stresses(*event.displacement, event.materials);
        writer.add_cell_data("stress", 6, stresses.stress);
        writer.add_cell_data("von_mises", 1, stresses.von_mises);
        if (event.displacement->pressure)
          writer.add_cell_data("pressure", 1, stresses.pressure);
      }
    writer.add_boundary();
    writer.add_text("scene", scene_name);
    for (const RecordColumn &column : record_columns({event.record}))
      if (column.kind == RecordColumn::Kind::text)
        {
          if (column.has_value(event.record))
            writer.add_text(column.name, column.text(event.record));
        }
      else if (const auto value = column.value(event.record))
        writer.add_value(column.name, *value);
    writer.write(path);
  }

  void
  VtuSeries::write_series() const
  {
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
                       "  <Collection>\n";
    for (const Entry &entry : entries)
      text += "    <DataSet timestep=\"" + std::to_string(entry.cycle)
              + "\" group=\"\" part=\"0\" file=\"" + entry.file + "\"/>\n";
    text += "  </Collection>\n</VTKFile>\n";
    folder.write(scene_name + ".pvd", text);
  }
} // namespace tetradapt::report

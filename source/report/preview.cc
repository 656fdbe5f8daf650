// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/preview.h"

#include "tetradapt/io/vtu_writer.h"
#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mesh/face_table.h"
#include "tetradapt/mesh/kept_places.h"
#include "tetradapt/report/record_columns.h"
#include "tetradapt/scene/words.h"

#include <algorithm>

namespace tetradapt::report
{
  namespace
  {
    using Rows = std::vector<std::vector<std::string>>;

    std::string
    number(const double value)
    {
      return format_number(value, 6);
    }

    /** A support, load or goal: its name in Patch::selections, and what it is. */
    struct Item
    {
      std::string name, kind;
    };

    std::string
    kind_of(const scene::SupportParameters &support)
    {
      if (support.type == scene::SupportType::sliding)
        return "slides";
      if (support.type == scene::SupportType::rigid)
        return "moves rigidly";
      if (support.type == scene::SupportType::spring)
        return scene::word(support.type) + ", " + scene::word(support.spring.direction);
      std::string components;
      for (unsigned int c = 0; c < 3; ++c)
        if (support.components[c])
          components += (components.empty() ? "" : ", ") + std::string(1, "xyz"[c]);
      return "holds " + components;
    }

    std::vector<Item>
    items_of(const scene::Scene &scene)
    {
      std::vector<Item> items;
      for (const auto &support : scene.supports)
        items.push_back({"Supports/" + support.name, kind_of(support)});
      for (const auto &load : scene.loads)
        items.push_back({"Loads/" + load.name, scene::word(load.type)});
      for (const auto &goal : scene.goals)
        items.push_back({"Goals/" + goal.name, scene::word(goal.type)});
      return items;
    }

    /** Per patch, whether it is selected by @p name. */
    std::vector<bool>
    selected_patches(const mesh::TetMesh &mesh, const std::string &name)
    {
      std::vector<bool> selected;
      for (const mesh::Patch &patch : mesh.patches)
        selected.push_back(std::count(patch.selections.begin(), patch.selections.end(), name) > 0);
      return selected;
    }

    /** Whether @p load acts on the body: no patch is named after it, and no vertex. */
    bool
    acts_on_body(const scene::LoadParameters &load, const mesh::TetMesh &mesh)
    {
      if (load.place.is_set())
        return false;
      const auto selected = selected_patches(mesh, "Loads/" + load.name);
      return std::count(selected.begin(), selected.end(), true) == 0;
    }

    std::set<int>
    regions_of(const scene::LoadParameters &load, const mesh::TetMesh &mesh)
    {
      return mechanics::resolve_regions(load.selector.ids,
                                        load.selector.groups,
                                        mesh,
                                        "Loads/" + load.name);
    }

    /** Number, area and centre of the faces of some patches. */
    struct Extent
    {
      unsigned int         n_faces = 0;
      double               area    = 0.;
      dealii::Tensor<1, 3> moment; ///< of the area about the origin

      Extent(const mesh::TetMesh &mesh, const std::vector<bool> &patches)
      {
        for (const mesh::BoundaryFace &face : mesh.faces)
          if (patches[face.patch])
            {
              const double part = mesh::face_area_vector(mesh, face).norm();
              ++n_faces;
              area += part;
              for (const unsigned int v : face.vertices)
                moment += part / 3. * dealii::Tensor<1, 3>(mesh.points[v]);
            }
      }

      std::vector<std::string>
      cells() const
      {
        std::vector<std::string> texts{std::to_string(n_faces), number(area)};
        // Rounding makes no centre of 1e-17 out of 0.
        double largest = 0.;
        for (unsigned int d = 0; d < 3; ++d)
          largest = std::max(largest, std::abs(moment[d]));
        for (unsigned int d = 0; d < 3; ++d)
          texts.push_back(
            area > 0.
              ? format_number(std::abs(moment[d]) < 1e-12 * largest ? 0. : moment[d] / area, 4)
              : "-");
        return texts;
      }
    };

    void
    append(std::vector<std::string> &row, const std::vector<std::string> &more)
    {
      row.insert(row.end(), more.begin(), more.end());
    }

    std::string
    face_table(const scene::Scene &scene, const mesh::TetMesh &mesh)
    {
      Rows rows{{"on faces", "what", "faces", "area", "centre x", "y", "z"}};
      for (const Item &item : items_of(scene))
        {
          const auto selected = selected_patches(mesh, item.name);
          if (std::count(selected.begin(), selected.end(), true) == 0)
            continue;
          rows.push_back({item.name, item.kind});
          append(rows.back(), Extent(mesh, selected).cells());
        }
      return aligned_table(rows, 2);
    }

    /** Points and lines with the places of their ends; empty if there is none. */
    std::string
    place_table(const scene::Scene &scene, const mesh::TetMesh &mesh)
    {
      Rows rows{{"at points", "what", "vertices", "x", "y", "z"}};
      for (const Item &item : items_of(scene))
        if (const mesh::KeptPlace *place = mesh::find_place(mesh, item.name))
          for (const dealii::Point<3> &end : place->ends)
            {
              const bool first = &end == &place->ends.front();
              rows.push_back({first ? item.name : "  to",
                              first ? item.kind : "",
                              first ? std::to_string(mesh::vertices_of(mesh, *place).size()) : ""});
              for (unsigned int d = 0; d < 3; ++d)
                rows.back().push_back(format_number(end[d], 4));
            }
      return rows.size() > 1 ? aligned_table(rows, 2) + "\n" : "";
    }

    /** Number and volume of the tetrahedra of some regions. */
    std::vector<std::string>
    body_cells(const mesh::TetMesh &mesh, const std::set<int> &regions)
    {
      unsigned int n_cells = 0;
      double       volume  = 0.;
      for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
        if (regions.count(mesh.regions[cell]) > 0)
          {
            ++n_cells;
            volume += mesh::cell_volume(mesh, cell);
          }
      return {std::to_string(n_cells), number(volume)};
    }

    std::string
    body_table(const scene::Scene           &scene,
               const mesh::TetMesh          &mesh,
               const mechanics::MaterialMap &materials)
    {
      Rows rows{{"in the body", "what", "tetrahedra", "volume"}};
      for (const auto &material : scene.materials)
        {
          std::set<int> regions;
          for (const int region : std::set<int>(mesh.regions.begin(), mesh.regions.end()))
            if (materials.parameters(region).name == material.name)
              regions.insert(region);
          rows.push_back({"Materials/" + material.name, "material"});
          append(rows.back(), body_cells(mesh, regions));
        }
      for (const auto &load : scene.loads)
        if (acts_on_body(load, mesh))
          {
            rows.push_back({"Loads/" + load.name, scene::word(load.type)});
            append(rows.back(), body_cells(mesh, regions_of(load, mesh)));
          }
      return aligned_table(rows, 2);
    }

    std::string
    boundary_table(const mesh::TetMesh &mesh)
    {
      std::map<int, std::vector<bool>> patches;
      std::map<int, std::string>       names;
      for (unsigned int p = 0; p < mesh.patches.size(); ++p)
        {
          auto &of_id = patches[mesh.patches[p].boundary_id];
          of_id.resize(mesh.patches.size(), false);
          of_id[p]                           = true;
          names[mesh.patches[p].boundary_id] = mesh.patches[p].name;
        }
      Rows rows{{"boundary id", "group", "faces", "area", "centre x", "y", "z"}};
      for (const auto &[id, of_id] : patches)
        {
          rows.push_back({std::to_string(id), names[id].empty() ? "-" : names[id]});
          append(rows.back(), Extent(mesh, of_id).cells());
        }
      return aligned_table(rows, 2);
    }

    /** For each face the cell behind it. */
    std::vector<unsigned int>
    cells_behind(const mesh::TetMesh &mesh)
    {
      std::vector<unsigned int> cells(mesh.faces.size(), 0);
      const unsigned int        n_slots = 4 * mesh.n_cells();
      mesh::FaceTable(mesh).for_each_triangle([&](const auto *first, const auto *last) {
        for (const auto *entry = first; entry != last; ++entry)
          if (entry->slot >= n_slots)
            cells[entry->slot - n_slots] = first->slot / 4;
      });
      return cells;
    }

    /** "7 left hand\n" for each. */
    template <class Names>
    std::string
    lines_of(const Names &names)
    {
      std::string text;
      for (const auto &[id, name] : names)
        if (!name.empty())
          text += std::to_string(id) + " " + name + "\n";
      return text;
    }

    /** Adds what the tetrahedra behind the faces know. */
    void
    add_body(io::VtuWriter                &writer,
             const scene::Scene           &scene,
             const mesh::TetMesh          &mesh,
             const mechanics::MaterialMap &materials)
    {
      std::vector<int>           regions, numbers;
      std::map<int, std::string> names;
      for (unsigned int m = 0; m < scene.materials.size(); ++m)
        names[m] = scene.materials[m].name;
      for (const unsigned int cell : cells_behind(mesh))
        {
          const std::string &material = materials.parameters(mesh.regions[cell]).name;
          regions.push_back(mesh.regions[cell]);
          for (const auto &[id, name] : names)
            if (name == material)
              numbers.push_back(id);
        }
      writer.add_cell_ids("region", regions);
      writer.add_cell_ids("material", numbers);
      writer.add_text("region_names", lines_of(mesh.region_names));
      writer.add_text("material_names", lines_of(names));
      for (const auto &load : scene.loads)
        if (acts_on_body(load, mesh))
          {
            const std::set<int> acted_on = regions_of(load, mesh);
            std::vector<int>    acts;
            for (const int region : regions)
              acts.push_back(acted_on.count(region));
            writer.add_cell_ids("Loads/" + load.name, acts);
          }
    }
  } // namespace

  std::string
  preview_tables(const scene::Scene &scene, const mesh::TetMesh &mesh)
  {
    const mechanics::MaterialMap materials(scene, mesh);
    return face_table(scene, mesh) + "\n" + place_table(scene, mesh)
           + body_table(scene, mesh, materials) + "\n" + boundary_table(mesh);
  }

  void
  write_preview(const std::string &file, const scene::Scene &scene, const mesh::TetMesh &mesh)
  {
    auto                writer = io::VtuWriter::of_boundary(mesh);
    std::vector<int>    patches, ids;
    std::vector<double> areas;
    for (const mesh::BoundaryFace &face : mesh.faces)
      {
        patches.push_back(face.patch);
        ids.push_back(mesh.patches[face.patch].boundary_id);
        areas.push_back(mesh::face_area_vector(mesh, face).norm());
      }
    writer.add_cell_ids("patch", patches);
    writer.add_cell_ids("boundary_id", ids);
    writer.add_cell_data("area", 1, areas);
    std::map<int, std::string> names;
    for (const mesh::Patch &patch : mesh.patches)
      names[patch.boundary_id] = patch.name;
    writer.add_text("boundary_names", lines_of(names));
    for (const Item &item : items_of(scene))
      {
        const auto selected = selected_patches(mesh, item.name);
        if (std::count(selected.begin(), selected.end(), true) == 0)
          continue;
        std::vector<int> acts;
        for (const int patch : patches)
          acts.push_back(selected[patch] ? 1 : 0);
        writer.add_cell_ids(item.name, acts);
      }
    add_body(writer, scene, mesh, mechanics::MaterialMap(scene, mesh));
    writer.write(file);
  }
} // namespace tetradapt::report

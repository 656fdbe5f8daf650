// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/reference_key.h"
#include "tetradapt/laws/law_catalogue.h"

#include "tetradapt/compare/fingerprint.h"
#include "tetradapt/core/exceptions.h"

#include <deal.II/base/config.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

// Set by the build for this room: they change with the packages.
#ifndef TETRADAPT_TETGEN_VERSION
#define TETRADAPT_TETGEN_VERSION "unknown"
#endif

namespace tetradapt::compare
{
  namespace
  {
    /** To be raised when the same scene gives another reference than before. */
    constexpr unsigned int method_version = 3;

    /** Names and values, one a line, with all digits; strings with their length. */
    class CanonicalText
    {
    public:
      CanonicalText()
      {
        text.precision(17);
      }
      void
      operator()(const char *name, const std::string &value)
      {
        text << name << ' ' << value.size() << ' ' << value << '\n';
      }
      template <typename T>
      void
      operator()(const char *name, const T &value)
      {
        text << name << ' ' << value << '\n';
      }
      template <typename T>
      void
      list(const char *name, const T &values)
      {
        (*this)(name, values.size());
        for (const auto &value : values)
          (*this)(name, value);
      }
      std::string
      str() const
      {
        return text.str();
      }

    private:
      std::ostringstream text;
    };

    void
    describe(CanonicalText &text, const scene::Selector &selector)
    {
      text.list("ids", selector.ids);
      text.list("groups", selector.groups);
      text("where", selector.where);
    }

    /** Nothing where there is no place: keys of other scenes stay as they are. */
    void
    describe(CanonicalText &text, const scene::PlaceParameters &place)
    {
      if (place.point)
        text("point", *place.point);
      if (place.line)
        {
          text("from", place.line->first);
          text("to", place.line->second);
        }
      if (place.is_set())
        text("radius", place.excluded_radius.value_or(-1.));
    }

    /** Whether the support acts along normals, which are those of a projection surface. */
    bool
    takes_normals(const scene::SupportParameters &support)
    {
      return support.type == scene::SupportType::sliding
             || support.type == scene::SupportType::spring;
    }

    /** Nothing for fixed supports: keys of other scenes stay as they are. */
    void
    describe_type(CanonicalText                  &text,
                  const scene::SupportParameters &support,
                  const scene::MeshParameters    &mesh)
    {
      if (support.type == scene::SupportType::fixed)
        return;
      text("support type", static_cast<int>(support.type));
      text("normal displacement", support.normal_displacement);
      if (takes_normals(support))
        {
          text("feature angle", mesh.feature_angle);
          text("projection", static_cast<int>(mesh.projection));
          text.list("functions", mesh.projection_functions);
        }
      const scene::RigidParameters &rigid = support.rigid;
      if (rigid.reference_point)
        text("reference point", *rigid.reference_point);
      for (const auto *motion : {&rigid.translation, &rigid.rotation})
        for (const auto &component : *motion)
          {
            text("prescribed", component.has_value());
            text("motion", component.value_or(0.));
          }
      text.list("force", rigid.force);
      text.list("moment", rigid.moment);
    }

    void
    describe_model(CanonicalText &text, const scene::Scene &scene)
    {
      text("formulation", static_cast<int>(scene.formulation));
      for (const auto &material : scene.materials)
        {
          text("material", material.name);
          text.list("regions", material.regions);
          text.list("groups", material.region_groups);
          text("law", material.law);
          for (const auto &[name, value] : laws::values_of(material.law, material.constants))
            text(name.c_str(), value);
          text("density", material.density);
          text("expansion", material.thermal_expansion);
        }
      for (const auto &support : scene.supports)
        {
          text("support", support.name);
          describe(text, support.selector);
          describe(text, support.place);
          text.list("components", support.components);
          text.list("displacement", support.displacement);
          describe_type(text, support, scene.mesh);
          if (support.type == scene::SupportType::spring)
            {
              text("spring", support.spring.stiffness);
              text("direction", static_cast<int>(support.spring.direction));
            }
        }
      for (const auto &load : scene.loads)
        {
          text("load", load.name);
          text("type", static_cast<int>(load.type));
          describe(text, load.selector);
          describe(text, load.place);
          text.list("value", load.value);
          text("smallest feature", load.smallest_feature);
          if (load.type == scene::LoadType::total_force)
            {
              text.list("moment", load.total.moment);
              text("distribution", static_cast<int>(load.total.distribution));
              for (unsigned int d = 0; load.total.about && d < 3; ++d)
                text("about", (*load.total.about)[d]);
            }
          if (load.type == scene::LoadType::rotation)
            {
              for (unsigned int d = 0; d < 3; ++d)
                text("axis point", load.rotation.axis_point[d]);
              for (unsigned int d = 0; load.rotation.axis && d < 3; ++d)
                text("axis", (*load.rotation.axis)[d]);
              text("angular velocity", load.rotation.angular_velocity);
            }
        }
      text("solver", static_cast<int>(scene.solver.type));
      text("tolerance", scene.solver.tolerance);
    }

    /** Hexahedra follow the scene's body, up to a tolerance, and its selections, as far
     * as these have the same areas. */
    void
    describe_hexahedra(CanonicalText       &text,
                       const scene::Scene  &scene,
                       const mesh::TetMesh &initial_mesh)
    {
      std::map<std::string, double> areas;
      for (const auto &face : initial_mesh.faces)
        for (const auto &name : initial_mesh.patches[face.patch].selections)
          areas[name] += mesh::face_area_vector(initial_mesh, face).norm();
      for (const auto &[name, area] : areas)
        {
          std::ostringstream rounded;
          rounded << area;
          text("selection", name);
          text("area", rounded.str());
        }
      text("degree", scene.reference.degree);
      text("tolerance", hexahedral_tolerance(scene));
      text("unknowns", scene.reference.max_dofs);
      text("iterations", scene.solver.max_iterations);
      text("blocks", scene.mesh.source == scene::MeshSource::blocks);
      text("lower", scene.mesh.lower_corner);
      text("upper", scene.mesh.upper_corner);
      for (const auto &block : scene.mesh.blocks)
        {
          text("from", block.first);
          text("to", block.second);
        }
      text.list("regions", scene.mesh.block_regions);
    }

    void
    describe_mesh_parameters(CanonicalText &text, const scene::Scene &scene)
    {
      const auto &reference = scene.reference;
      text("degree", reference.degree);
      text("route", static_cast<int>(reference.route));
      switch (reference.route)
        {
        case scene::ReferenceParameters::MeshRoute::bricks:
          text.list("cells", reference.cells);
          text("lower", scene.mesh.lower_corner);
          text("upper", scene.mesh.upper_corner);
          return;
        case scene::ReferenceParameters::MeshRoute::file:
          return; // its content is added elsewhere, its name does not matter
        case scene::ReferenceParameters::MeshRoute::refine:
          text("TetGen", std::string(TETRADAPT_TETGEN_VERSION));
          text("volume bound", reference.volume_bound);
          text("size", reference.size);
          text("radius-edge ratio", reference.radius_edge_ratio);
          text("dihedral angle", reference.dihedral_angle);
          text("optimisation", scene.tetgen.optimisation_level);
          text("scheme", scene.tetgen.optimisation_scheme);
          text("points", scene.tetgen.steiner_points);
          text("boundary", scene.tetgen.keep_boundary);
          text("projection", static_cast<int>(scene.mesh.projection));
          text.list("functions", scene.mesh.projection_functions);
        }
    }

    template <typename T>
    void
    add_vector(Fingerprint &hash, const std::vector<T> &values)
    {
      hash.add(values.data(), values.size() * sizeof(T));
    }

    void
    add_mesh(Fingerprint &hash, const mesh::TetMesh &mesh)
    {
      add_vector(hash, mesh.points);
      add_vector(hash, mesh.cells);
      add_vector(hash, mesh.regions);
      add_vector(hash, mesh.faces);
      CanonicalText text;
      for (const auto &patch : mesh.patches)
        {
          text("patch", patch.boundary_id);
          text("name", patch.name);
          text.list("selections", patch.selections);
        }
      hash.add(text.str());
    }

    void
    add_file(Fingerprint &hash, const std::string &name)
    {
      std::error_code error;
      if (!std::filesystem::is_regular_file(name, error))
        throw core::InputError("The reference's mesh file '" + name
                               + "' is no file. Correct Reference/File.");
      std::ifstream     file(name, std::ios::binary);
      const std::string content{std::istreambuf_iterator<char>(file),
                                std::istreambuf_iterator<char>()};
      if (!file.good() && !file.eof())
        throw core::InputError("The reference's mesh file '" + name
                               + "' cannot be read. Correct Reference/File.");
      hash.add(content);
    }

    /** A file's bytes; all of the three that make up a .node mesh. */
    void
    add_mesh_file(Fingerprint &hash, const std::string &name)
    {
      const std::filesystem::path path(name);
      const std::string           ending = path.extension().string();
      hash.add(ending);
      if (ending != ".node" && ending != ".ele" && ending != ".face")
        return add_file(hash, name);
      for (const char *part : {".node", ".ele", ".face"})
        {
          auto here = path;
          here.replace_extension(part);
          if (std::filesystem::exists(here))
            {
              hash.add(std::string(part));
              add_file(hash, here.string());
            }
        }
    }
  } // namespace

  double
  hexahedral_tolerance(const scene::Scene &scene)
  {
    if (scene.reference.tolerance > 0.)
      return scene.reference.tolerance;
    return scene.adaptivity.tolerance > 0. ? .1 * scene.adaptivity.tolerance : 1e-3;
  }

  std::string
  reference_key(const scene::Scene &scene, const mesh::TetMesh &initial_mesh)
  {
    CanonicalText text;
    text("method", method_version);
    text("deal.II", std::string(DEAL_II_PACKAGE_VERSION));
    const bool hexahedra = scene.reference.type == scene::ReferenceParameters::Type::hexahedra;
    text("hexahedra", hexahedra);
    describe_model(text, scene);
    if (hexahedra)
      describe_hexahedra(text, scene, initial_mesh);
    else
      describe_mesh_parameters(text, scene);
    // Materials may name regions by what the initial mesh calls them.
    for (const auto &region : initial_mesh.region_names)
      {
        text("region", region.first);
        text("name", region.second);
      }
    Fingerprint hash;
    hash.add(text.str());
    if (hexahedra)
      return hash.hex();
    const bool refines = scene.reference.route == scene::ReferenceParameters::MeshRoute::refine;
    if (refines)
      add_mesh(hash, initial_mesh);
    if (scene.mesh.projection == scene::MeshParameters::Projection::surface
        && (refines || std::any_of(scene.supports.begin(), scene.supports.end(), takes_normals)))
      add_file(hash,
               scene.mesh.projection_file.empty() ? scene.mesh.files.front()
                                                  : scene.mesh.projection_file);
    if (scene.reference.route == scene::ReferenceParameters::MeshRoute::file)
      add_mesh_file(hash, scene.reference.file);
    return hash.hex();
  }
} // namespace tetradapt::compare

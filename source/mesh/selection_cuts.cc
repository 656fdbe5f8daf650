// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/selection_cuts.h"

#include "facet_triangles.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/geometry/surface_cutting.h"
#include "tetradapt/mesh/finalize.h"
#include "tetradapt/mesh/selection.h"

#include <algorithm>
#include <map>
#include <sstream>

namespace tetradapt::mesh
{
  namespace
  {
    using Selectors = std::vector<std::pair<std::string, scene::Selector>>;
    using Complex   = PiecewiseLinearComplex;

    std::vector<geometry::SurfaceCut>
    cuts_of(const Complex &plc, const Selectors &selectors)
    {
      std::vector<geometry::SurfaceCut> cuts;
      for (const auto &[name, selector] : selectors)
        {
          if (selector.where.empty())
            continue;
          const auto lists = [&plc, &selector = selector](const int id) {
            if (id >= static_cast<int>(plc.patches.size()))
              return false;
            const Patch &patch = plc.patches[id];
            return (selector.ids.empty() && selector.groups.empty())
                   || std::count(selector.ids.begin(), selector.ids.end(), patch.boundary_id) > 0
                   || std::count(selector.groups.begin(), selector.groups.end(), patch.name) > 0;
          };
          cuts.push_back({name, core::Condition(selector.where, name + "/Where"), lists});
        }
      return cuts;
    }

    /** One warning a selection, of its shortest edge. */
    void
    warn_of_short_edges(const geometry::CutSurface &cut, const core::Log &log)
    {
      struct Entry
      {
        unsigned int                    count = 0;
        geometry::CutSurface::ShortEdge shortest;
      };
      std::map<std::string, Entry> entries;
      for (const auto &edge : cut.short_edges)
        {
          Entry &entry = entries[edge.name];
          if (entry.count++ == 0 || edge.length < entry.shortest.length)
            entry.shortest = edge;
        }
      for (const auto &[name, entry] : entries)
        {
          std::ostringstream text;
          text << (name.empty() ? std::string("The crossing borders of selections")
                                : name + ": the border of what it selects")
               << " forces " << entry.count
               << " edges on the mesh that are shorter than a hundredth of the size wanted there ("
               << entry.shortest.local_size << "); the shortest, at "
               << to_string(entry.shortest.middle) << ", has a length of " << entry.shortest.length
               << ". The mesh becomes very fine there. If this is not meant, move the border onto "
                  "an edge of the body or away from it.";
          log.warning(text.str());
        }
    }

    /** The boundary's facets as faces of a mesh without cells, a polygon by its largest
     * triangle. */
    TetMesh
    faces_of(const Complex &plc)
    {
      TetMesh mesh;
      mesh.points  = plc.points;
      mesh.patches = plc.patches;
      for (const auto &facet : plc.facets)
        {
          if (facet.patch == Complex::inner)
            continue;
          BoundaryFace largest;
          double       area = -1.;
          for (std::size_t i = 2; i < facet.vertices.size(); ++i)
            {
              const BoundaryFace face{
                {{facet.vertices[0], facet.vertices[i - 1], facet.vertices[i]}}, facet.patch};
              const double its = face_area_vector(mesh, face).norm();
              if (its > area)
                {
                  area    = its;
                  largest = face;
                }
            }
          mesh.faces.push_back(largest);
        }
      return mesh;
    }
  } // namespace

  bool
  borders_are_cut(const scene::MeshParameters &parameters)
  {
    return parameters.source == scene::MeshSource::box
           || parameters.source == scene::MeshSource::blocks
           || parameters.source == scene::MeshSource::surface;
  }

  PiecewiseLinearComplex
  with_selections(const PiecewiseLinearComplex                  &plc,
                  const Selectors                               &selectors,
                  const std::function<double(const Point<3> &)> &local_size,
                  const core::Log                               &log)
  {
    Complex    result = plc;
    const auto cuts   = cuts_of(plc, selectors);
    FaceRule   rule   = FaceRule::interior;
    if (!cuts.empty())
      try
        {
          const FacetTriangles triangles(plc);
          const auto           cut = geometry::cut_surface(triangles.surface, cuts, local_size);
          warn_of_short_edges(cut, log);
          result = with_cut_facets(plc, triangles, cut);
        }
      catch (const core::NumericalError &error)
        {
          log.warning(error.what()
                      + std::string(" The borders of selections are not cut into the surface: "
                                    "its facets are selected as a whole."));
          rule = FaceRule::whole;
        }
    return with_split_patches(result, [&](TetMesh &faces) {
      report_straddled(select_faces(faces, selectors, rule), log);
    });
  }

  PiecewiseLinearComplex
  with_split_patches(const PiecewiseLinearComplex &plc, const std::function<void(TetMesh &)> &split)
  {
    TetMesh faces = faces_of(plc);
    split(faces);
    Complex result    = plc;
    result.patches    = faces.patches;
    unsigned int next = 0;
    for (auto &facet : result.facets)
      if (facet.patch != Complex::inner)
        facet.patch = faces.faces[next++].patch;
    return result;
  }
} // namespace tetradapt::mesh

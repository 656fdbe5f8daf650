// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/selection.h"

#include "face_test.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/finalize.h"
#include "tetradapt/scene/nearest_names.h"

#include <algorithm>
#include <set>
#include <sstream>

namespace tetradapt::mesh
{
  namespace
  {
    template <typename Container>
    std::string
    join(const Container &items)
    {
      std::string text;
      for (const auto &item : items)
        {
          text += text.empty() ? "" : ", ";
          if constexpr (std::is_same_v<std::decay_t<decltype(item)>, std::string>)
            text += "'" + item + "'";
          else
            text += std::to_string(item);
        }
      return text;
    }



    /** The ids and names of the patches that have faces. */
    struct Choice
    {
      std::set<int>         ids;
      std::set<std::string> groups;

      explicit Choice(const TetMesh &mesh)
      {
        std::vector<bool> has_faces(mesh.patches.size(), false);
        for (const BoundaryFace &face : mesh.faces)
          has_faces[face.patch] = true;
        for (unsigned int p = 0; p < mesh.patches.size(); ++p)
          if (has_faces[p])
            {
              ids.insert(mesh.patches[p].boundary_id);
              if (!mesh.patches[p].name.empty())
                groups.insert(mesh.patches[p].name);
            }
      }

      std::string
      text() const
      {
        return "The mesh has the boundary ids " + join(ids) + " and "
               + (groups.empty() ? std::string("no named groups") : "the groups " + join(groups))
               + ".";
      }
    };



    /** All listed ids and groups must exist on the boundary. */
    void
    check_lists(const std::string &name, const scene::Selector &selector, const Choice &choice)
    {
      for (const int id : selector.ids)
        if (choice.ids.count(id) == 0)
          throw core::InputError(name + " selects the boundary id " + std::to_string(id)
                                 + ", but no face of the mesh's boundary has it. " + choice.text());
      for (const std::string &group : selector.groups)
        if (choice.groups.count(group) == 0)
          {
            const auto nearest
              = scene::nearest_names(group, {choice.groups.begin(), choice.groups.end()});
            throw core::InputError(name + " selects the group '" + group
                                   + "', but no face of the mesh's boundary is in it. "
                                   + (nearest.empty() ? "" : "Did you mean '" + nearest[0] + "'? ")
                                   + choice.text());
          }
    }



    [[noreturn]] void
    refuse_empty(const TetMesh         &mesh,
                 const std::string     &name,
                 const scene::Selector &selector,
                 const Choice          &choice,
                 const FaceRule         rule)
    {
      const auto [lower, upper] = bounding_box(mesh);
      std::string among;
      if (!selector.ids.empty())
        among += " with boundary id " + join(selector.ids);
      if (!selector.groups.empty())
        among += (among.empty() ? " in group " : " or in group ") + join(selector.groups);
      throw core::InputError(
        name + " selects no face of the boundary: '" + selector.where + "' does not hold at "
        + (rule == FaceRule::whole ? "the three corners and the centroid of" : "the centroid of")
        + " any face" + among + ". The mesh extends from " + to_string(lower) + " to "
        + to_string(upper) + ". " + choice.text()
        + " Correct the expression; leave room for rounding, as in 'x < 1e-9'.");
    }
    void
    add_face(const TetMesh      &mesh,
             const BoundaryFace &face,
             const bool          is_selected,
             FaceTest           &test,
             SelectedFaces      &found)
    {
      const double area = face_area_vector(mesh, face).norm();
      if (is_selected)
        {
          ++found.n_faces;
          found.area += area;
        }
      if (!test.is_straddled(face))
        return;
      const double share = test.share(face);
      found.n_straddled += share > 0. && share < 1. ? 1 : 0;
      found.uncertain_area += (is_selected ? 1. - share : share) * area;
      found.excess_area += ((is_selected ? 1. : 0.) - share) * area;
    }
  } // namespace



  void
  check_names(const TetMesh &mesh, const std::string &name, const scene::Selector &selector)
  {
    check_lists(name, selector, Choice(mesh));
  }



  std::vector<SelectedFaces>
  select_faces(TetMesh                                                    &mesh,
               const std::vector<std::pair<std::string, scene::Selector>> &selectors,
               const FaceRule                                              rule)
  {
    const Choice                   choice(mesh);
    std::vector<SelectedFaces>     result;
    std::vector<std::vector<bool>> selected(mesh.faces.size(),
                                            std::vector<bool>(selectors.size(), false));
    for (unsigned int s = 0; s < selectors.size(); ++s)
      {
        const auto &[name, selector] = selectors[s];
        check_lists(name, selector, choice);
        FaceTest      test(mesh, selector, name, rule);
        SelectedFaces found;
        found.name = name;
        for (unsigned int f = 0; f < mesh.faces.size(); ++f)
          {
            selected[f][s] = test.selects(mesh.faces[f]);
            add_face(mesh, mesh.faces[f], selected[f][s], test, found);
          }
        if (found.n_faces == 0)
          refuse_empty(mesh, name, selector, choice, rule);
        result.push_back(found);
      }

    // Number the combinations that occur in the order of the map.
    std::map<std::pair<unsigned int, std::vector<bool>>, unsigned int> combinations;
    for (unsigned int f = 0; f < mesh.faces.size(); ++f)
      combinations.emplace(std::make_pair(mesh.faces[f].patch, selected[f]), 0);
    std::vector<Patch> patches;
    for (auto &[combination, number] : combinations)
      {
        number      = patches.size();
        Patch patch = mesh.patches[combination.first];
        for (unsigned int s = 0; s < selectors.size(); ++s)
          if (combination.second[s])
            patch.selections.push_back(selectors[s].first);
        patches.push_back(patch);
      }
    for (unsigned int f = 0; f < mesh.faces.size(); ++f)
      mesh.faces[f].patch = combinations.at({mesh.faces[f].patch, selected[f]});
    mesh.patches = std::move(patches);
    return result;
  }

  void
  report_straddled(const std::vector<SelectedFaces> &found, const core::Log &log)
  {
    constexpr double worth_a_warning = 0.01;
    for (const SelectedFaces &selection : found)
      {
        if (selection.n_straddled == 0)
          continue;
        const double       right = selection.area - selection.excess_area;
        const double       share = selection.uncertain_area / std::max(selection.area, right);
        std::ostringstream text;
        text << selection.name << ": the border of what it selects runs through "
             << selection.n_straddled
             << " faces of the mesh, which it selects as a whole or not at all: an area of "
             << selection.area << " is selected, the expression holds on " << right << "; "
             << 100. * share << " % of the area is wrong.";
        if (share > worth_a_warning)
          log.warning(text.str()
                      + " Make the mesh follow the border, or use Mesh/Type = box, blocks or "
                        "surface, where it is cut into the surface.");
        else
          log.info(text.str());
      }
  }

  std::map<std::string, double>
  selected_areas(const TetMesh &mesh)
  {
    std::map<std::string, double> areas;
    for (const BoundaryFace &face : mesh.faces)
      for (const std::string &name : mesh.patches[face.patch].selections)
        areas[name] += face_area_vector(mesh, face).norm();
    return areas;
  }
} // namespace tetradapt::mesh

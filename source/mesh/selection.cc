// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/selection.h"

#include "tetradapt/core/condition.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/mesh_checks.h"
#include "tetradapt/scene/nearest_names.h"

#include <algorithm>
#include <memory>
#include <set>

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



    /** Whether expressions hold at the corners of faces, each corner asked once. */
    class FaceTest
    {
    public:
      FaceTest(const TetMesh &mesh, const scene::Selector &selector, const std::string &name)
        : mesh(mesh), in_list(mesh.patches.size(),
                              selector.ids.empty() && selector.groups.empty() ? true : false)
      {
        for (unsigned int p = 0; p < mesh.patches.size(); ++p)
          if (std::count(selector.ids.begin(), selector.ids.end(), mesh.patches[p].boundary_id) > 0
              || std::count(selector.groups.begin(), selector.groups.end(), mesh.patches[p].name)
                   > 0)
            in_list[p] = true;
        if (!selector.where.empty())
          {
            expression = std::make_unique<core::Condition>(selector.where, name + "/Where");
            holds_at.assign(mesh.n_points(), unknown);
          }
      }

      bool
      selects(const BoundaryFace &face)
      {
        if (!in_list[face.patch])
          return false;
        if (!expression)
          return true;
        for (const unsigned int v : face.vertices)
          {
            if (holds_at[v] == unknown)
              holds_at[v] = expression->holds(mesh.points[v]) ? yes : no;
            if (holds_at[v] == no)
              return false;
          }
        // In this form the centroid lies exactly in a plane x = const with its face.
        const Point<3> &p = mesh.points[face.vertices[0]];
        return expression->holds(
          p + ((mesh.points[face.vertices[1]] - p) + (mesh.points[face.vertices[2]] - p)) / 3.);
      }

    private:
      enum : char
      {
        unknown,
        yes,
        no
      };
      const TetMesh                   &mesh;
      std::vector<bool>                in_list; ///< per patch
      std::unique_ptr<core::Condition> expression;
      std::vector<char>                holds_at; ///< per point
    };



    [[noreturn]] void
    refuse_empty(const TetMesh         &mesh,
                 const std::string     &name,
                 const scene::Selector &selector,
                 const Choice          &choice)
    {
      const auto [lower, upper] = bounding_box(mesh);
      std::string among;
      if (!selector.ids.empty())
        among += " with boundary id " + join(selector.ids);
      if (!selector.groups.empty())
        among += (among.empty() ? " in group " : " or in group ") + join(selector.groups);
      throw core::InputError(
        name + " selects no face of the boundary: '" + selector.where
        + "' does not hold at the three corners and the centroid of any face" + among
        + ". The mesh extends from " + to_string(lower) + " to " + to_string(upper) + ". "
        + choice.text() + " Correct the expression; leave room for rounding, as in 'x < 1e-9'.");
    }
  } // namespace



  std::vector<SelectedFaces>
  select_faces(TetMesh &mesh, const std::vector<std::pair<std::string, scene::Selector>> &selectors)
  {
    const Choice                   choice(mesh);
    std::vector<SelectedFaces>     result;
    std::vector<std::vector<bool>> selected(mesh.faces.size(),
                                            std::vector<bool>(selectors.size(), false));
    for (unsigned int s = 0; s < selectors.size(); ++s)
      {
        const auto &[name, selector] = selectors[s];
        check_lists(name, selector, choice);
        FaceTest      test(mesh, selector, name);
        SelectedFaces found{name, 0, 0.};
        for (unsigned int f = 0; f < mesh.faces.size(); ++f)
          if (test.selects(mesh.faces[f]))
            {
              selected[f][s] = true;
              ++found.n_faces;
              found.area += face_area_vector(mesh, mesh.faces[f]).norm();
            }
        if (found.n_faces == 0)
          refuse_empty(mesh, name, selector, choice);
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
} // namespace tetradapt::mesh

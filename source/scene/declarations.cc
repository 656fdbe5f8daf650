// SPDX-License-Identifier: AGPL-3.0-or-later
#include "declarations.h"

#include "binder.h"

#include <boost/property_tree/json_parser.hpp>

#include <sstream>

namespace tetradapt::scene
{
  const std::string name_placeholder = "<name>";

  namespace
  {
    const std::vector<std::pair<std::string, std::string>> &
    section_texts()
    {
      static const std::vector<std::pair<std::string, std::string>> texts{
        {"Mesh", "The mesh, or the meshes, that the scene is solved on."},
        {"TetGen", "How TetGen is run, for first meshes and for refinement."},
        {"Materials", "One subsection for each material, with a name of your choice."},
        {"Supports", "Prescribed displacements: one subsection each, with a name of your choice."},
        {"Loads", "Loads: one subsection each, with a name of your choice."},
        {"Solver", "How the linear systems are solved."},
        {"Reference", "The fine solution that the error is measured against."},
        {"Exact solution", "What is known about the exact solution."},
        {"Goals", "Quantities of interest: one subsection each, with a name of your choice."},
        {"Estimation",
         "Which error estimators are computed in addition to the refinement indicator."},
        {"Adaptivity", "Whether and how the mesh changes from cycle to cycle."},
        {"Output", "What is written, and where."},
        {"Study",
         "What a study varies: one subsection for each, with a name of your choice. The scene is "
         "run for every combination of their cases."}};
      return texts;
    }

    void
    bind_top(Scene &scene, Binder &binder)
    {
      binder("Title", scene.title, text_codec(), "Title of the scene, for output and plots.");
      binder("Degree",
             scene.degree,
             count_codec(),
             "Polynomial degree of the displacement: 1 (linear) or 2 (quadratic).");
      binder(
        "Formulation",
        scene.formulation,
        word_codec<Formulation>(),
        "The unknowns and the theory: displacement, with small strains; mixed, with small "
        "strains, the displacement of degree 2 and the pressure of degree 1, for materials "
        "that are nearly or, with a Poisson ratio of 0.5, fully incompressible; finite strain, "
        "the displacement with large deformation, for laws that are made for that.");
    }

    /** Calls @p act with each part of @p scene inside its section. */
    template <class AnyScene, class Action>
    void
    visit(AnyScene &scene, dealii::ParameterHandler &prm, const Action &act)
    {
      const auto in = [&](const std::string &section, auto &part) {
        prm.enter_subsection(section);
        act(part);
        prm.leave_subsection();
      };
      const auto in_blocks = [&](const std::string &section, auto &parts) {
        prm.enter_subsection(section);
        for (auto &part : parts)
          in(part.name, part);
        prm.leave_subsection();
      };
      in("Mesh", scene.mesh);
      in("TetGen", scene.tetgen);
      in_blocks("Materials", scene.materials);
      in_blocks("Supports", scene.supports);
      in_blocks("Loads", scene.loads);
      in("Solver", scene.solver);
      in("Reference", scene.reference);
      in("Exact solution", scene.exact_solution);
      in_blocks("Goals", scene.goals);
      in("Estimation", scene.estimation);
      in("Adaptivity", scene.adaptivity);
      in("Output", scene.output);
      in_blocks("Study", scene.variations);
    }

    template <class Block>
    void
    add_to(std::vector<Block>       &blocks,
           const std::string        &section,
           const std::string        &name,
           dealii::ParameterHandler &prm)
    {
      Block block;
      block.name = name;
      prm.enter_subsection(section);
      prm.enter_subsection(name);
      block.declare(prm);
      prm.leave_subsection();
      prm.leave_subsection();
      blocks.push_back(block);
    }

    SectionTree
    tree_of(const std::string &name, const boost::property_tree::ptree &node)
    {
      SectionTree tree;
      tree.name = name;
      for (const auto &[child_name, child] : node)
        if (child.find("value") != child.not_found())
          tree.entries.push_back({child_name,
                                  child.get<std::string>("default_value", ""),
                                  child.get<std::string>("documentation", ""),
                                  child.get<std::string>("pattern_description", "")});
        else
          tree.sections.push_back(tree_of(child_name, child));
      return tree;
    }
  } // namespace

  Scene
  template_scene()
  {
    Scene scene;
    scene.materials.resize(1);
    scene.supports.resize(1);
    scene.loads.resize(1);
    scene.goals.resize(1);
    scene.variations.resize(1);
    scene.materials[0].name = scene.supports[0].name = scene.loads[0].name = name_placeholder;
    scene.goals[0].name = scene.variations[0].name = name_placeholder;
    return scene;
  }

  bool
  has_named_blocks(const std::string &section)
  {
    return section == "Materials" || section == "Supports" || section == "Loads"
           || section == "Goals" || section == "Study";
  }

  std::string
  section_documentation(const std::string &section)
  {
    for (const auto &entry : section_texts())
      if (entry.first == section)
        return entry.second;
    return "";
  }

  void
  declare(const Scene &scene, dealii::ParameterHandler &prm)
  {
    Scene  top = scene;
    Binder binder(prm, Binder::Action::declare);
    bind_top(top, binder);
    visit(scene, prm, [&](const auto &part) { part.declare(prm); });
  }

  void
  add_block(const std::string        &section,
            const std::string        &name,
            Scene                    &scene,
            dealii::ParameterHandler &prm)
  {
    if (section == "Materials")
      add_to(scene.materials, section, name, prm);
    else if (section == "Supports")
      add_to(scene.supports, section, name, prm);
    else if (section == "Loads")
      add_to(scene.loads, section, name, prm);
    else if (section == "Goals")
      add_to(scene.goals, section, name, prm);
    else
      add_to(scene.variations, section, name, prm);
  }

  void
  parse(Scene &scene, dealii::ParameterHandler &prm, Mistakes &mistakes)
  {
    Binder binder(prm, Binder::Action::parse);
    bind_top(scene, binder);
    visit(scene, prm, [&](auto &part) { mistakes.attempt_reading([&]() { part.parse(prm); }); });
  }

  const SectionTree *
  SectionTree::section(const std::string &wanted) const
  {
    for (const auto &section : sections)
      if (section.name == wanted || section.name == name_placeholder)
        return &section;
    return nullptr;
  }

  const SectionTree::Entry *
  SectionTree::entry(const std::string &wanted) const
  {
    for (const auto &entry : entries)
      if (entry.name == wanted)
        return &entry;
    return nullptr;
  }

  std::vector<std::string>
  SectionTree::section_names() const
  {
    std::vector<std::string> names;
    for (const auto &section : sections)
      names.push_back(section.name);
    return names;
  }

  std::vector<std::string>
  SectionTree::entry_names() const
  {
    std::vector<std::string> names;
    for (const auto &entry : entries)
      names.push_back(entry.name);
    return names;
  }

  SectionTree
  section_tree(const dealii::ParameterHandler &prm)
  {
    // deal.II offers no other way to list what has been declared.
    using Handler = dealii::ParameterHandler;
    std::stringstream json;
    prm.print_parameters(json, Handler::OutputStyle(Handler::JSON | Handler::KeepDeclarationOrder));
    boost::property_tree::ptree tree;
    boost::property_tree::read_json(json, tree);
    return tree_of("", tree);
  }
} // namespace tetradapt::scene

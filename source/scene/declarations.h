// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_declarations_h
#define tetradapt_scene_declarations_h

#include "tetradapt/scene/mistakes.h"
#include "tetradapt/scene/scene.h"

#include <deal.II/base/parameter_handler.h>

namespace tetradapt::scene
{
  /** The name that stands for any name a user may choose. */
  extern const std::string name_placeholder;

  /** A scene with one block of each kind, called name_placeholder: what can be
   * written, with the defaults. */
  Scene
  template_scene();

  /** Whether the blocks of @p section ("Materials") have names that users choose. */
  bool
  has_named_blocks(const std::string &section);

  /** What a top-level section is about. */
  std::string
  section_documentation(const std::string &section);

  /** Declares all parameters with the values of @p scene as defaults. */
  void
  declare(const Scene &scene, dealii::ParameterHandler &prm);

  /** Adds to @p scene and declares in @p prm a block with default values, for
   * example "bone" in "Materials". */
  void
  add_block(const std::string        &section,
            const std::string        &name,
            Scene                    &scene,
            dealii::ParameterHandler &prm);

  /** Reads all parameters of @p prm, which must declare the blocks that @p scene
   * has. Values that contradict each other in a block are added to @p mistakes. */
  void
  parse(Scene &scene, dealii::ParameterHandler &prm, Mistakes &mistakes);

  /** A section of what is declared, in the order of declaration. */
  struct SectionTree
  {
    struct Entry
    {
      std::string name, default_value, documentation, expected;
    };
    std::string              name; ///< empty for the top
    std::vector<Entry>       entries;
    std::vector<SectionTree> sections;

    /** The subsection @p wanted, or the one with the placeholder's name; null if
     * there is neither. */
    const SectionTree *
    section(const std::string &wanted) const;

    /** Null if there is none. */
    const Entry *
    entry(const std::string &wanted) const;

    std::vector<std::string>
    section_names() const;
    std::vector<std::string>
    entry_names() const;
  };

  /** Everything that @p prm declares. */
  SectionTree
  section_tree(const dealii::ParameterHandler &prm);
} // namespace tetradapt::scene

#endif

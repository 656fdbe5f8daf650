// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_parameter_printer_h
#define tetradapt_scene_parameter_printer_h

#include "tetradapt/scene/scene.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace tetradapt::scene
{
  enum class ParameterFormat
  {
    prm,     ///< a parameter file, documentation as comments
    json,    ///< as deal.II's ParameterHandler writes it
    markdown ///< one table a section
  };

  /** Prints all parameters with defaults and documentation; blocks with names
   * that users choose appear once, called <name>. */
  void
  print_parameters(std::ostream &stream, ParameterFormat format);

  /** All parameters of @p scene in the format of a scene's file: reading them
   * again gives the same scene (from the same working directory). */
  std::string
  effective_parameters(const Scene &scene);
} // namespace tetradapt::scene

#endif

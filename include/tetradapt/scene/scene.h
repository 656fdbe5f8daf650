// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_scene_h
#define tetradapt_scene_scene_h

#include "tetradapt/scene/mesh_parameters.h"
#include "tetradapt/scene/model_parameters.h"
#include "tetradapt/scene/study_parameters.h"

namespace tetradapt::scene
{
  /**
   * Everything that a user asked for, as plain data. Readers fill it; nothing
   * below this room knows in which format it was written.
   */
  struct Scene
  {
    std::string  name; ///< file name without folder and ending
    std::string  file; ///< as given on the command line
    std::string  title;
    unsigned int degree = 1; ///< Lagrange degree of the displacement, 1 or 2

    MeshParameters                  mesh;
    TetgenParameters                tetgen;
    std::vector<MaterialParameters> materials;
    std::vector<SupportParameters>  supports;
    std::vector<LoadParameters>     loads;
    SolverParameters                solver;
    ReferenceParameters             reference;
    TruthParameters                 truth;
    AdaptivityParameters            adaptivity;
    OutputParameters                output;

    /** Checks each part and how they fit together. @throws InputError. */
    void check() const;
  };
} // namespace tetradapt::scene

#endif

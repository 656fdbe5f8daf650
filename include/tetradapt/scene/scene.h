// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_scene_h
#define tetradapt_scene_scene_h

#include "tetradapt/scene/error_estimator.h"
#include "tetradapt/scene/goal_parameters.h"
#include "tetradapt/scene/mesh_parameters.h"
#include "tetradapt/scene/model_parameters.h"
#include "tetradapt/scene/study_parameters.h"
#include "tetradapt/scene/variation_parameters.h"

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
    unsigned int degree      = 1; ///< Lagrange degree of the displacement, 1 or 2
    Formulation  formulation = Formulation::displacement;

    MeshParameters                  mesh;
    TetgenParameters                tetgen;
    std::vector<MaterialParameters> materials;
    std::vector<SupportParameters>  supports;
    std::vector<LoadParameters>     loads;
    SolverParameters                solver;
    ReferenceParameters             reference;
    ExactSolutionParameters         exact_solution;
    std::vector<GoalParameters>     goals;
    EstimationParameters            estimation;
    AdaptivityParameters            adaptivity;
    OutputParameters                output;
    /** What a study varies; each run of it has none. */
    std::vector<VariationParameters> variations;

    /** Where the user wrote what: from a full name such as "Loads/tip/Value" (or
     * of a section, "Loads/tip") to "file:line" or "command line". Parameters
     * that were left at their defaults have no entry. */
    std::map<std::string, std::string> places;

    /** Checks each part and how they fit together.
     * @throws InputError "<full name>: <what is wrong and what to change>". */
    void
    check() const;

    /** What is allowed but probably not meant, one message each; for a scene
     * that check() accepts. */
    std::vector<std::string>
    warnings() const;

    /**
     * @p message with the place in front at which the user wrote the parameter
     * that it starts with: "Loads/tip/Value, component x: ..." becomes
     * "beam.prm:31: Loads/tip/Value, component x: ...". If only the section was
     * written, its place is taken; a message that does not start with a full
     * name comes back as it is. Messages of every room that start with a full
     * name can be completed this way.
     */
    std::string
    with_place(const std::string &message) const;
  };
} // namespace tetradapt::scene

#endif

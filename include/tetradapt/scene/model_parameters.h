// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_model_parameters_h
#define tetradapt_scene_model_parameters_h

#include "tetradapt/laws/constants.h"
#include "tetradapt/laws/formulation.h"

#include <deal.II/base/point.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

/**
 * Every struct here has three functions: declare() adds its parameters, with its
 * present values as defaults, to the subsection that the ParameterHandler is in;
 * parse() reads them from there; check() looks at the values and throws
 * core::InputError "Section/Name: what is wrong and what to change".
 */
namespace tetradapt::scene
{
  /**
   * Which part of the boundary (or, for loads on the body, which regions) something acts on:
   * the faces whose boundary id or named group is listed (all, if neither list is given), and
   * of them the part on which the condition holds, if one is given. The border of that part is
   * cut into the surface of a box, of blocks and of a surface file before it is meshed
   * (geometry::cut_surface()), so that each face lies inside or outside as a whole. Meshes
   * that cannot be cut are selected face by face: where the condition holds at the three
   * vertices and the centroid. See doc/selections.md.
   */
  struct Selector
  {
    std::vector<int>         ids;
    std::vector<std::string> groups;
    std::string              where; ///< condition in x, y, z; empty: everywhere

    bool
    empty() const
    {
      return ids.empty() && groups.empty() && where.empty();
    }
  };

  /**
   * A point, or a straight line, where something acts on vertices or edges that every mesh of
   * a run has. The energy of a solution that is held or loaded there does not converge:
   * errors leave out what is within a radius of it.
   */
  struct PlaceParameters
  {
    std::optional<dealii::Point<3>>                              point;
    std::optional<std::pair<dealii::Point<3>, dealii::Point<3>>> line; ///< its ends
    /** What errors leave out; empty: default_radius times the body's largest extent, 0:
     * nothing. */
    std::optional<double> excluded_radius;

    static constexpr double default_radius = 0.05;

    bool
    is_set() const
    {
      return point || line;
    }
    /** Whether errors leave anything out. */
    bool
    excludes() const
    {
      return is_set() && excluded_radius.value_or(default_radius) > 0.;
    }
  };

  using laws::Formulation;

  /** A material and the regions that it fills. */
  struct MaterialParameters
  {
    std::string              name;
    std::vector<int>         regions;       ///< region ids; both lists empty: everywhere else
    std::vector<std::string> region_groups; ///< names of regions
    std::string              law = "linear elastic"; ///< name in laws::law_catalogue()
    laws::Constants          constants;              ///< of the law; see laws::make_law()
    double                   density           = 0.; ///< mass per volume
    double                   thermal_expansion = 0.; ///< strain per degree

    /** Young's modulus and Poisson's ratio at rest.
     * @throws core::InputError if there is no such law, or it refuses its constants. */
    laws::ModuliAtRest
    moduli_at_rest() const;

    void
    declare(dealii::ParameterHandler &prm) const;
    void
    parse(dealii::ParameterHandler &prm);
    void
    check() const;
  };

  /** What a support does to its faces. */
  enum class SupportType
  {
    fixed,   ///< prescribes components of the displacement
    sliding, ///< prescribes the displacement along the normal only
    rigid,   ///< couples all of them rigidly to one reference point
    spring   ///< an elastic foundation
  };

  /** How faces that are coupled to a reference point move: u = t + R x (x - x_ref). */
  struct RigidParameters
  {
    using Motion = std::array<std::optional<double>, 3>; ///< nothing: free

    std::optional<dealii::Point<3>> reference_point; ///< none: the centroid of the faces
    Motion                          translation;     ///< t
    Motion                          rotation;        ///< R, in radians
    /** What acts at the reference point, constants; on free components only. */
    std::array<std::string, 3> force{{"0", "0", "0"}}, moment{{"0", "0", "0"}};

    bool
    operator==(const RigidParameters &other) const
    {
      return reference_point == other.reference_point && translation == other.translation
             && rotation == other.rotation && force == other.force && moment == other.moment;
    }
  };

  /** Which displacements the springs of a support resist. */
  enum class SpringDirection
  {
    normal, ///< those along the normal
    all
  };

  /** Of a support of type SupportType::spring: its traction on the body is
   * -k (u - u0), or -k ((u - u0) . n) n, with u0 its SupportParameters::displacement. */
  struct SpringParameters
  {
    std::string     stiffness = "0"; ///< k, force per area and displacement; in x, y, z
    SpringDirection direction = SpringDirection::normal;
  };

  /** What holds or moves a part of the boundary, a point or a line. */
  struct SupportParameters
  {
    std::string name;
    SupportType type = SupportType::fixed;
    Selector    selector;
    /** Those that are prescribed; none by springs. */
    std::array<bool, 3>        components{{true, true, true}};
    std::array<std::string, 3> displacement{{"0", "0", "0"}}; ///< in x, y, z, t
    PlaceParameters            place;                     ///< if it is set, no faces are selected
    std::string                normal_displacement = "0"; ///< of a sliding one, outward, in x, y, z
    RigidParameters            rigid;                     ///< of a rigid one
    SpringParameters           spring;

    void
    declare(dealii::ParameterHandler &prm) const;
    void
    parse(dealii::ParameterHandler &prm);
    void
    check() const;
  };

  enum class LoadType
  {
    traction,    ///< force per area, on faces
    pressure,    ///< force per area against the outer normal, on faces
    body_force,  ///< force per volume, on regions
    gravity,     ///< acceleration times the material's density, on regions
    nodal_force, ///< a force at every node (point of the mesh) of the faces, as LML has it
    total_force, ///< a traction on faces with a given resultant, on every mesh
    rotation,    ///< centrifugal force of a body that turns about an axis, on regions
    temperature, ///< temperature change: thermal strain alpha T I, on regions
    point_force  ///< a force at one point
  };

  /** Whether loads of this type are chosen by faces; others by regions or a point. */
  bool
  acts_on_faces(LoadType type);

  /** Whether loads of this type are forces per area. */
  bool
  acts_on_surface(LoadType type);

  /** How a total force is spread over the faces. */
  enum class Distribution
  {
    even,   ///< a constant and, for the moment, the field of a rotation
    bearing ///< as a pin presses on a hole: -n . d where that is positive
  };

  /** What a total force has in addition to LoadParameters::value, the force. */
  struct TotalForceParameters
  {
    std::array<std::string, 3>      moment{{"0", "0", "0"}}; ///< constants
    std::optional<dealii::Point<3>> about; ///< of the moment; none: centroid of the faces
    Distribution                    distribution = Distribution::even;
  };

  /** Of a load of type LoadType::rotation. */
  struct RotationParameters
  {
    dealii::Point<3>                axis_point;            ///< on the axis
    std::optional<dealii::Point<3>> axis;                  ///< its direction, of any length
    double                          angular_velocity = 0.; ///< radians per time
  };

  /** A load. */
  struct LoadParameters
  {
    std::string name;
    LoadType    type = LoadType::traction;
    /** Faces or regions (ids, groups): see acts_on_faces(). */
    Selector selector;
    /** Expressions in x, y, z, t: three for vectors, one (the first) for
     * pressure and temperature. A total force has three constants, a rotation none. */
    std::array<std::string, 3> value{{"0", "0", "0"}};
    /** Size of the smallest thing that the value may show: a peak, a patch, half a wave. The
     * value is looked at with this spacing; 0: a hundredth of the body's size. */
    double smallest_feature = 0.;
    /** Point forces only: the point. */
    PlaceParameters      place;
    TotalForceParameters total;
    RotationParameters   rotation;

    void
    declare(dealii::ParameterHandler &prm) const;
    void
    parse(dealii::ParameterHandler &prm);
    void
    check() const;
  };

  /** What is known of the true solution; any of these may be empty. */
  struct ExactSolutionParameters
  {
    /** Exact displacement as expressions in x, y, z. */
    std::array<std::string, 3> displacement;
    /** Its gradient du_i/dx_j, row by row; empty: by differences of order six. */
    std::array<std::string, 9> gradient;
    /** Known strain energy, 1/2 int (eps - eps_th) : C : (eps - eps_th); 0: unknown. Where
     * loads act alone, it is half of their work F(u) on the displacement they cause. */
    double strain_energy = 0.;

    bool
    has_displacement() const
    {
      return !displacement[0].empty();
    }
    bool
    has_gradient() const
    {
      return !gradient[0].empty();
    }
    bool
    has_energy() const
    {
      return strain_energy != 0.;
    }
    void
    declare(dealii::ParameterHandler &prm) const;
    void
    parse(dealii::ParameterHandler &prm);
    void
    check() const;
  };
} // namespace tetradapt::scene

#endif

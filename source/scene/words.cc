// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/scene/words.h"

namespace tetradapt::scene
{
  const Words<Formulation> &
  words(Formulation)
  {
    static const Words<Formulation> table{{Formulation::displacement, "displacement"},
                                          {Formulation::mixed, "mixed"},
                                          {Formulation::finite_strain, "finite strain"}};
    return table;
  }

  const Words<MeshSource> &
  words(MeshSource)
  {
    static const Words<MeshSource> table{{MeshSource::box, "box"},
                                         {MeshSource::blocks, "blocks"},
                                         {MeshSource::bricks, "bricks"},
                                         {MeshSource::file, "file"},
                                         {MeshSource::surface, "surface"}};
    return table;
  }

  const Words<SupportType> &
  words(SupportType)
  {
    static const Words<SupportType> table{{SupportType::fixed, "fixed"},
                                          {SupportType::sliding, "sliding"},
                                          {SupportType::rigid, "rigid"},
                                          {SupportType::spring, "spring"}};
    return table;
  }

  const Words<SpringDirection> &
  words(SpringDirection)
  {
    static const Words<SpringDirection> table{{SpringDirection::normal, "normal"},
                                              {SpringDirection::all, "all"}};
    return table;
  }

  const Words<LoadType> &
  words(LoadType)
  {
    static const Words<LoadType> table{{LoadType::traction, "traction"},
                                       {LoadType::pressure, "pressure"},
                                       {LoadType::nodal_force, "nodal force"},
                                       {LoadType::body_force, "body force"},
                                       {LoadType::gravity, "gravity"},
                                       {LoadType::total_force, "total force"},
                                       {LoadType::rotation, "rotation"},
                                       {LoadType::temperature, "temperature"},
                                       {LoadType::point_force, "point force"}};
    return table;
  }

  const Words<Distribution> &
  words(Distribution)
  {
    static const Words<Distribution> table{{Distribution::even, "even"},
                                           {Distribution::bearing, "bearing"}};
    return table;
  }

  const Words<SolverParameters::Type> &
  words(SolverParameters::Type)
  {
    using Type = SolverParameters::Type;
    static const Words<Type> table{{Type::automatic, "automatic"},
                                   {Type::cg, "cg"},
                                   {Type::direct, "direct"}};
    return table;
  }

  const Words<ReferenceParameters::Type> &
  words(ReferenceParameters::Type)
  {
    using Type = ReferenceParameters::Type;
    static const Words<Type> table{{Type::none, "none"},
                                   {Type::fine_mesh, "fine mesh"},
                                   {Type::hexahedra, "hexahedra"},
                                   {Type::run, "earlier run"}};
    return table;
  }

  const Words<ReferenceParameters::MeshRoute> &
  words(ReferenceParameters::MeshRoute)
  {
    using Route = ReferenceParameters::MeshRoute;
    static const Words<Route> table{{Route::refine, "refine"},
                                    {Route::bricks, "bricks"},
                                    {Route::file, "file"}};
    return table;
  }

  const Words<AdaptivityParameters::Strategy> &
  words(AdaptivityParameters::Strategy)
  {
    using Strategy = AdaptivityParameters::Strategy;
    static const Words<Strategy> table{{Strategy::none, "none"},
                                       {Strategy::mesh_list, "mesh list"},
                                       {Strategy::uniform, "uniform"},
                                       {Strategy::adaptive, "adaptive"}};
    return table;
  }

  const Words<ErrorEstimator> &
  words(ErrorEstimator)
  {
    using E = ErrorEstimator;
    static const Words<E> table{{E::energy, "energy"},
                                {E::ren, "ren"},
                                {E::exact, "exact"},
                                {E::degree_extrapolation, "degree extrapolation"},
                                {E::local_degree_extrapolation, "local degree extrapolation"},
                                {E::richardson, "richardson"},
                                {E::averaging, "averaging"},
                                {E::spr, "spr"},
                                {E::residual, "residual"},
                                {E::interpolation, "interpolation"},
                                {E::goal, "goal"},
                                {E::equilibrated, "equilibrated"}};
    return table;
  }

  const Words<GoalType> &
  words(GoalType)
  {
    static const Words<GoalType> table{{GoalType::point_displacement, "point displacement"},
                                       {GoalType::mean_displacement, "mean displacement"},
                                       {GoalType::point_stress, "point stress"},
                                       {GoalType::mean_stress, "mean stress"},
                                       {GoalType::functional, "functional"}};
    return table;
  }

  const Words<MeshParameters::Projection> &
  words(MeshParameters::Projection)
  {
    using Projection = MeshParameters::Projection;
    static const Words<Projection> table{{Projection::none, "none"},
                                         {Projection::surface, "surface"},
                                         {Projection::expression, "expression"}};
    return table;
  }

  const Words<SolverParameters::Stopping> &
  words(SolverParameters::Stopping)
  {
    using Stopping = SolverParameters::Stopping;
    static const Words<Stopping> table{{Stopping::residual, "residual"},
                                       {Stopping::discretisation, "discretisation"}};
    return table;
  }

  const Words<SolverParameters::Multigrid> &
  words(SolverParameters::Multigrid)
  {
    using Multigrid = SolverParameters::Multigrid;
    static const Words<Multigrid> table{{Multigrid::aggregation, "aggregation"},
                                        {Multigrid::trilinos, "trilinos"}};
    return table;
  }

  const Words<AdaptivityParameters::Marking> &
  words(AdaptivityParameters::Marking)
  {
    using Marking = AdaptivityParameters::Marking;
    static const Words<Marking> table{{Marking::maximum, "maximum"},
                                      {Marking::fixed_fraction, "fixed fraction"},
                                      {Marking::doerfler, "doerfler"},
                                      {Marking::optimal_size, "optimal size"}};
    return table;
  }

  const Words<AdaptivityParameters::SizeControl> &
  words(AdaptivityParameters::SizeControl)
  {
    using SizeControl = AdaptivityParameters::SizeControl;
    static const Words<SizeControl> table{{SizeControl::node_sizes, "node sizes"},
                                          {SizeControl::volume_constraints, "volume constraints"}};
    return table;
  }
} // namespace tetradapt::scene

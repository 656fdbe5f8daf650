// SPDX-License-Identifier: AGPL-3.0-or-later
#include "stress.h"

#include "tetradapt/core/failure.h"

#include "batch.h"
#include "improvement.h"
#include "tractions.h"

#include <algorithm>
#include <memory>

namespace tetradapt::estimate
{
  EquilibratedStress::EquilibratedStress(const mesh::NodalField       &u_h,
                                         const mesh::NodalField       &galerkin,
                                         const scene::Scene           &scene,
                                         const mechanics::MaterialMap &materials,
                                         MPI_Comm                      communicator,
                                         const double                  near)
    : states(u_h, materials), faces(u_h.mesh()), loads(face_loads(scene, galerkin)),
      edges(u_h.degree() == 2 ? u_h.shared_edges()
                              : std::make_shared<mesh::EdgeTable>(mesh::build_edges(u_h.mesh()))),
      mesh(u_h.mesh())
  {
    std::unique_ptr<CellStates> other_states;
    if (&galerkin != &u_h)
      other_states = std::make_unique<CellStates>(galerkin, materials);
    core::together(communicator, [&] {
      FaceTractions tractions(galerkin,
                              other_states == nullptr ? states : *other_states,
                              faces,
                              loads,
                              compare::own_slice(mesh.n_cells(), communicator));
      moments = std::move(tractions.moments);
    });
    if (near > 0. && is_within(near, communicator))
      return;
    const TractionMoves moves(mesh, *edges, faces, loads);
    improve_tractions(mesh, faces, moves, states, communicator, moments);
  }

  bool
  EquilibratedStress::is_within(const double distance, MPI_Comm communicator)
  {
    std::vector<double> sum(1, 0.);
    core::together(communicator, [&] {
      const auto own = compare::own_slice(mesh.n_cells(), communicator);
      for (const double energy : energies(own.begin, own.end))
        sum[0] += energy;
    });
    compare::sum_over_ranks(sum, communicator);
    return sum[0] <= distance * distance;
  }

  std::vector<double>
  EquilibratedStress::energies(const unsigned int first, const unsigned int last) const
  {
    std::vector<double> result;
    const auto          batch = std::make_unique<CellBatch>();
    CellState           state;
    for (unsigned int cell = first; cell < last; cell += CellBatch::size)
      {
        const unsigned int used = std::min<unsigned int>(CellBatch::size, last - cell);
        for (unsigned int lane = 0; lane < CellBatch::size; ++lane)
          {
            const unsigned int c = cell + std::min(lane, used - 1);
            states.compute(c, state);
            states.load(c, state, faces, moments, *batch, lane);
          }
        minimise_energy(*batch);
        for (unsigned int lane = 0; lane < used; ++lane)
          result.push_back(std::max(0., batch->energy[lane]));
      }
    return result;
  }

  std::vector<SymmetricTensor<2, 3>>
  EquilibratedStress::values(const unsigned int                    cell,
                             const unsigned int                    part,
                             const std::vector<mesh::Barycentric> &points) const
  {
    const auto batch = std::make_unique<CellBatch>();
    CellState  state;
    states.compute(cell, state);
    for (unsigned int lane = 0; lane < CellBatch::size; ++lane)
      states.load(cell, state, faces, moments, *batch, lane);
    Lanes               all[EquilibratedElement::n_stress];
    std::vector<double> stress;
    minimal_stress(*batch, all);
    for (const Lanes &lanes : all)
      stress.push_back(lanes[0]);

    const auto  &corners = mesh.cells[cell];
    Tensor<2, 3> F;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int k = 0; k < 3; ++k)
        F[i][k] = mesh.points[corners[k + 1]][i] - mesh.points[corners[0]][i];
    std::vector<SymmetricTensor<2, 3>> result;
    for (const auto &b : points)
      {
        const auto            c = EquilibratedElement::value(stress.data(), part, b);
        SymmetricTensor<2, 3> S;
        S[0][0] = c[0];
        S[1][1] = c[1];
        S[2][2] = c[2];
        S[1][2] = c[3];
        S[0][2] = c[4];
        S[0][1] = c[5];
        SymmetricTensor<2, 3> value
          = symmetrize(F * Tensor<2, 3>(S) * transpose(F)) / (6. * state.volume);
        for (unsigned int i = 0; i < 4; ++i)
          value += b[i] * state.stress[i];
        for (unsigned int e = 0; e < 6; ++e)
          value += 4. * b[mesh::edge_vertices[e][0]] * b[mesh::edge_vertices[e][1]]
                   * state.stress[4 + e];
        result.push_back(value);
      }
    return result;
  }
} // namespace tetradapt::estimate

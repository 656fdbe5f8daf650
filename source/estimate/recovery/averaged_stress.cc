// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/recovery/averaged_stress.h"

#include "stress_conditions.h"

#include "tetradapt/compare/field_evaluator.h"
#include "tetradapt/estimate/recovery/polynomial_fit.h"

namespace tetradapt::estimate
{
  namespace
  {
    /** Where the nodes of a cell are; the mesh's order of edges. */
    mesh::Barycentric
    node_place(const unsigned int i)
    {
      mesh::Barycentric b{{0., 0., 0., 0.}};
      if (i < 4)
        b[i] = 1.;
      else
        b[mesh::edge_vertices[i - 4][0]] = b[mesh::edge_vertices[i - 4][1]] = 0.5;
      return b;
    }

    /** The least-squares problem of one node. */
    struct NodeProblem
    {
      const ElasticMatrices *elastic;
      double                 matrix[6][6] = {}, right[6] = {};
    };
  } // namespace

  void
  AveragedStress::number_slots(const mesh::NodalField &u_h)
  {
    const mesh::TetMesh &mesh = u_h.mesh();
    // The first region that a node is met in has the node's number; others get more.
    std::vector<int>                                     first(u_h.n_nodes());
    std::vector<char>                                    met(u_h.n_nodes(), 0);
    std::map<std::pair<unsigned int, int>, unsigned int> further;
    n_slots = u_h.n_nodes();
    slots.resize(std::size_t(mesh.n_cells()) * n_per_cell);
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      for (unsigned int i = 0; i < n_per_cell; ++i)
        {
          const unsigned int node = u_h.node(cell, i);
          unsigned int       slot = node;
          if (met[node] == 0)
            {
              met[node]   = 1;
              first[node] = mesh.regions[cell];
            }
          else if (first[node] != mesh.regions[cell])
            {
              const auto found = further.emplace(std::make_pair(node, mesh.regions[cell]), n_slots);
              if (found.second)
                ++n_slots;
              slot = found.first->second;
            }
          slots[std::size_t(cell) * n_per_cell + i] = slot;
        }
  }

  AveragedStress::AveragedStress(const mesh::NodalField &u_h,
                                 const CellStress       &stress,
                                 const GivenLoads       *loads)
    : n_per_cell(u_h.n_nodes_per_cell())
  {
    const mesh::TetMesh &mesh = u_h.mesh();
    number_slots(u_h);
    means.assign(6 * std::size_t(n_slots), 0.);
    std::vector<double>            volumes(n_slots, 0.);
    std::vector<mesh::Barycentric> places;
    for (unsigned int i = 0; i < n_per_cell; ++i)
      places.push_back(node_place(i));
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      {
        const double volume = mesh::cell_volume(mesh, cell);
        for (unsigned int i = 0; i < n_per_cell; ++i)
          {
            double s[6];
            stress.at(cell, places[i], compare::position(mesh, cell, places[i]), s);
            const unsigned int slot = slots[std::size_t(cell) * n_per_cell + i];
            volumes[slot] += volume;
            for (unsigned int c = 0; c < 6; ++c)
              means[6 * std::size_t(slot) + c] += volume * s[c];
          }
      }
    for (unsigned int slot = 0; slot < n_slots; ++slot)
      if (volumes[slot] > 0.) // a point of the mesh that no cell has is no node
        for (unsigned int c = 0; c < 6; ++c)
          means[6 * std::size_t(slot) + c] /= volumes[slot];
    if (loads != nullptr)
      correct_boundary(u_h, stress, *loads);
  }

  void
  AveragedStress::correct_boundary(const mesh::NodalField &u_h,
                                   const CellStress       &stress,
                                   const GivenLoads       &loads)
  {
    const mesh::TetMesh      &mesh = u_h.mesh();
    const RecoveryPatches     patches(mesh);
    const StressConditions    conditions(u_h, stress, patches, loads);
    std::vector<unsigned int> number(n_slots, dealii::numbers::invalid_unsigned_int);
    std::vector<unsigned int> problem_slots;
    std::vector<NodeProblem>  problems;
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      for (unsigned int f = conditions.begin[cell]; f < conditions.begin[cell + 1]; ++f)
        {
          const StressConditions::Face &face = conditions.faces[f];
          for (unsigned int i = 0; i < n_per_cell; ++i)
            {
              const mesh::Barycentric place = node_place(i);
              if (place[face.local_face] != 0.)
                continue; // not on the face
              const unsigned int slot = slots[std::size_t(cell) * n_per_cell + i];
              if (number[slot] == dealii::numbers::invalid_unsigned_int)
                {
                  number[slot] = problems.size();
                  problems.push_back({&stress.materials()[cell], {}, {}});
                  problem_slots.push_back(slot);
                }
              NodeProblem &problem = problems[number[slot]];
              double       right[6];
              const double weight = face.weight_at(place);
              face.right_at(place, right);
              for (unsigned int a = 0; a < 6; ++a)
                {
                  problem.right[a] += weight * right[a];
                  for (unsigned int b = 0; b < 6; ++b)
                    problem.matrix[a][b] += weight * face.matrix[a][b];
                }
            }
        }
    for (unsigned int k = 0; k < problems.size(); ++k)
      {
        NodeProblem &problem = problems[k];
        double      *mean    = &means[6 * std::size_t(problem_slots[k])], scale[6];
        // As in PatchSolver, distances are energies.
        for (unsigned int a = 0; a < 6; ++a)
          for (unsigned int b = 0; b < 6; ++b)
            {
              const double metric
                = 2. * problem.elastic->shear_modulus * problem.elastic->metric[a][b];
              problem.matrix[a][b] += metric;
              problem.right[a] += metric * mean[b];
            }
        if (!factorize(problem.matrix, scale, 1e-12))
          continue;
        solve_factorized(problem.matrix, scale, problem.right);
        std::copy(problem.right, problem.right + 6, mean);
      }
  }
} // namespace tetradapt::estimate

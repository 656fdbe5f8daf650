// SPDX-License-Identifier: AGPL-3.0-or-later

// The cache of references: what is read is what was written; damage anywhere is
// noticed; the key depends on what determines a reference and on nothing else.

#include "tetradapt/compare/reference_cache.h"
#include "tetradapt/compare/fingerprint.h"
#include "tetradapt/compare/reference_key.h"

#include "test_meshes.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <set>

using namespace test_meshes;
using namespace tetradapt::compare;

namespace
{
  const std::string file = "reference_cache_test.bin";
  const std::string key(32, 'a');

  template <typename T>
  bool
  same(const std::vector<T> &a, const std::vector<T> &b)
  {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
  }

  std::string
  content()
  {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }

  std::string
  problem_with(const std::string &bytes)
  {
    std::ofstream(file, std::ios::binary) << bytes;
    const CacheResult result = read_reference_cache(file, key);
    return result.reference ? "none noticed" : result.problem;
  }

  CachedReference
  example()
  {
    CachedReference reference;
    reference.mesh              = *cube(2, shaken(2, 0.2, 1));
    reference.mesh.patches      = {{3, "left wall", {"Supports/a", "Loads/b"}}, {7, "", {}}};
    reference.mesh.faces        = {{{{0, 1, 4}}, 0}, {{{1, 2, 5}}, 1}};
    reference.mesh.region_names = {{0, "bone"}, {1, ""}};
    reference.degree            = 2;
    Random random(3);
    for (unsigned int i = 0; i < 125; ++i)
      reference.values.push_back(Tensor<1, 3>({random(), random(), random()}));
    reference.energy          = 4.004140;
    reference.estimated_error = 1e-3;
    reference.seconds         = 12.5;
    reference.description     = "P2, on a cube";
    return reference;
  }

  void
  check_round_trip(const CachedReference &a)
  {
    write_reference_cache(file, key, a);
    const CacheResult result = read_reference_cache(file, key);
    if (!result.reference)
      {
        std::cout << "NOT READ: " << result.problem << std::endl;
        return;
      }
    const CachedReference &b       = *result.reference;
    bool                   patches = b.mesh.patches.size() == 2 && same(a.mesh.faces, b.mesh.faces);
    for (unsigned int i = 0; patches && i < 2; ++i)
      patches = a.mesh.patches[i].boundary_id == b.mesh.patches[i].boundary_id
                && a.mesh.patches[i].name == b.mesh.patches[i].name
                && a.mesh.patches[i].selections == b.mesh.patches[i].selections;
    std::cout << "round trip: mesh "
              << (same(a.mesh.points, b.mesh.points) && same(a.mesh.cells, b.mesh.cells)
                  && a.mesh.regions == b.mesh.regions && a.mesh.region_names == b.mesh.region_names)
              << ", boundary " << patches << ", displacement "
              << (a.degree == b.degree && same(a.values, b.values)) << ", figures "
              << (a.energy == b.energy && a.estimated_error == b.estimated_error
                  && a.seconds == b.seconds && a.description == b.description)
              << std::endl;
  }

  void
  check_damage()
  {
    const std::string good      = content();
    unsigned int      unnoticed = 0;
    for (std::size_t i = 0; i < good.size(); i += i < 200 ? 1 : 97)
      for (const char flip : {1, -128})
        {
          std::string bad = good;
          bad[i]          = static_cast<char>(bad[i] ^ flip);
          unnoticed += problem_with(bad) == "none noticed";
        }
    std::cout << "single bits flipped, unnoticed: " << unnoticed << std::endl;
    unnoticed = 0;
    for (std::size_t n = 0; n < good.size(); n += n < 200 ? 1 : 97)
      unnoticed += problem_with(good.substr(0, n)) == "none noticed";
    std::cout << "truncated, unnoticed: " << unnoticed << std::endl;
    std::string swapped = good;
    std::swap_ranges(swapped.begin() + 200, swapped.begin() + 208, swapped.begin() + 240);
    std::cout << "empty: " << problem_with("") << std::endl
              << "text: " << problem_with(std::string(500, 'x')) << std::endl
              << "truncated by one byte: " << problem_with(good.substr(0, good.size() - 1))
              << std::endl
              << "one byte more: " << problem_with(good + '\0') << std::endl
              << "two numbers exchanged: " << problem_with(swapped) << std::endl
              << "unchanged: " << problem_with(good) << std::endl;
    const CacheResult other = read_reference_cache(file, std::string(32, 'b'));
    std::cout << "other key: " << other.problem << std::endl;
    std::filesystem::remove(file);
    const CacheResult missing = read_reference_cache(file, key);
    std::cout << "no file: " << (missing.reference || !missing.problem.empty() ? "WRONG" : "none")
              << std::endl;
    std::filesystem::create_directory(file);
    std::cout << "a folder of this name: " << read_reference_cache(file, key).problem << std::endl;
    std::filesystem::remove(file);
  }

  void
  check_keys()
  {
    const auto   mesh = cube(1, [](const Point<3> &p) { return p; });
    scene::Scene scene;
    scene.materials.resize(1);
    scene.supports.resize(1);
    scene.loads.resize(1);
    scene.reference.type         = scene::ReferenceParameters::Type::fine_mesh;
    scene.reference.volume_bound = 0.01;
    const std::string original   = reference_key(scene, *mesh);

    std::set<std::string> keys{original};
    unsigned int          changes = 0;
    const auto            changed = [&](const std::function<void(scene::Scene &)> &change) {
      scene::Scene copy = scene;
      change(copy);
      keys.insert(reference_key(copy, *mesh));
      ++changes;
    };
    changed([](scene::Scene &s) { s.materials[0].young_modulus *= 1. + 1e-15; });
    changed([](scene::Scene &s) { s.materials[0].poisson_ratio = 0.31; });
    changed([](scene::Scene &s) { s.materials[0].regions = {0}; });
    changed([](scene::Scene &s) { s.materials.resize(2); });
    changed([](scene::Scene &s) { s.supports[0].components[1] = false; });
    changed([](scene::Scene &s) { s.supports[0].selector.where = "x<1e-9"; });
    changed([](scene::Scene &s) { s.supports[0].displacement[2] = "0.1"; });
    changed([](scene::Scene &s) { s.loads[0].value[2] = "-1"; });
    changed([](scene::Scene &s) { s.loads[0].type = scene::LoadType::pressure; });
    changed([](scene::Scene &s) { s.loads[0].selector.groups = {"ab", "c"}; });
    changed([](scene::Scene &s) { s.loads[0].selector.groups = {"a", "bc"}; });
    changed([](scene::Scene &s) { s.reference.degree = 1; });
    changed([](scene::Scene &s) { s.reference.volume_bound = 0.02; });
    changed([](scene::Scene &s) { s.reference.size = "0.1"; });
    changed([](scene::Scene &s) { s.reference.dihedral_angle = 12.; });
    changed([](scene::Scene &s) { s.tetgen.optimisation_level = 1; });
    changed([](scene::Scene &s) { s.solver.tolerance = 1e-9; });
    changed(
      [](scene::Scene &s) { s.reference.route = scene::ReferenceParameters::MeshRoute::bricks; });
    auto moved = *mesh;
    moved.points[3][1] += 1e-15;
    keys.insert(reference_key(scene, moved));
    moved                       = *mesh;
    moved.patches               = {{1, "", {"Loads/a"}}};
    const std::string one_patch = reference_key(scene, moved);
    keys.insert(one_patch);
    std::cout << "changes that matter: " << changes + 2 << ", different keys: " << keys.size() - 1
              << std::endl;

    scene::Scene same                 = scene;
    same.adaptivity.max_cycles        = 9;
    same.output.vtu                   = false;
    same.degree                       = 2;
    same.title                        = "other";
    same.tetgen.time_limit            = 1.;
    same.exact_solution.strain_energy = 1.;
    std::cout << "changes that do not matter: "
              << (reference_key(same, *mesh) == original ? "same key" : "OTHER KEY") << std::endl;

    scene.reference.route = scene::ReferenceParameters::MeshRoute::file;
    scene.reference.file  = "reference_cache_test.msh";
    std::ofstream(scene.reference.file) << "one";
    const std::string one = reference_key(scene, *mesh);
    std::ofstream(scene.reference.file) << "two";
    const std::string two = reference_key(scene, *mesh);
    std::filesystem::remove(scene.reference.file);
    std::cout << "file's content: " << (one != two ? "other key" : "SAME KEY") << std::endl;
  }

  void
  check_fingerprint()
  {
    // Every single bit and every length up to 200 bytes gives another hash.
    std::set<std::string> hashes;
    unsigned int          n = 0;
    const std::string     zeros(200, '\0');
    for (unsigned int length = 0; length <= 200; ++length, ++n)
      {
        Fingerprint hash;
        hash.add(zeros.substr(0, length));
        hashes.insert(hash.hex());
      }
    for (unsigned int bit = 0; bit < 8 * 200; ++bit, ++n)
      {
        std::string text = zeros;
        text[bit / 8]    = static_cast<char>(1 << (bit % 8));
        Fingerprint hash;
        hash.add(text);
        hashes.insert(hash.hex());
      }
    std::cout << "hashed: " << n << ", different: " << hashes.size() << std::endl;
  }
} // namespace

int
main()
{
  check_round_trip(example());
  check_damage();
  check_keys();
  check_fingerprint();
}

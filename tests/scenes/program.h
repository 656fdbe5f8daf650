// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_tests_scenes_program_h
#define tetradapt_tests_scenes_program_h

#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

/** Runs the program as a user does and reads what it wrote. All of it happens in
 * the folder `work` of the test's own working directory: there, deal.II's test
 * scripts keep a file `output`, which the program's own folder must not meet. */
namespace program
{
  namespace fs = std::filesystem;

  /** A new, empty folder is entered before main() begins. */
  inline const bool is_in_own_folder = [] {
    fs::remove_all("work");
    fs::create_directory("work");
    fs::current_path("work");
    return true;
  }();

  inline std::string
  read(const fs::path &file)
  {
    std::ifstream      stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }

  inline void
  write(const fs::path &file, const std::string &text)
  {
    std::ofstream(file, std::ios::binary) << text;
  }

  inline bool
  contains(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }

  inline void
  check(const std::string &what, bool holds)
  {
    std::cout << what << ": " << (holds ? "yes" : "NO") << std::endl;
  }

  /** Whether two numbers agree to @p tolerance times the second. */
  inline bool
  near(const double a, const double b, const double tolerance)
  {
    return std::abs(a - b) <= tolerance * std::abs(b);
  }

  /** The program's name. */
  inline std::string
  binary()
  {
    const char *name = std::getenv("TETRADAPT_PROGRAM");
    if (name == nullptr)
      {
        std::cerr << "Set TETRADAPT_PROGRAM to the program's name; ctest does.\n";
        std::exit(1);
      }
    return name;
  }

  struct Result
  {
    int         code;
    std::string out;
    std::string err;
  };

  /** @p before comes in front of the program's name: variables, or mpirun. */
  inline Result
  run(const std::string &arguments, const std::string &before = "")
  {
    const int status
      = std::system((before + " '" + binary() + "' " + arguments + " >out.txt 2>err.txt").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read("out.txt"), read("err.txt")};
  }

  /** A scene that comes with the program. */
  inline std::string
  scene(const std::string &name)
  {
    return (fs::path(SOURCE_DIR).parent_path().parent_path() / "prm" / name).string();
  }

  /** A convergence.csv: a column a name; no number where it has none. */
  class Table
  {
  public:
    explicit Table(const fs::path &folder)
    {
      std::ifstream            file(folder / "convergence.csv");
      std::string              line;
      std::vector<std::string> names;
      while (std::getline(file, line))
        {
          std::istringstream cells(line);
          std::string        cell;
          for (unsigned int c = 0; std::getline(cells, cell, ','); ++c)
            if (names.size() <= c && columns.empty())
              names.push_back(cell);
            else
              {
                columns[names.at(c)].push_back(number(cell));
                words[names.at(c)].push_back(cell);
              }
          if (columns.empty())
            for (const auto &name : names)
              columns[name];
          else
            for (auto &column : columns) // an empty last cell
              column.second.resize(columns.at("cycle").size(), std::nan(""));
        }
    }

    unsigned int
    n_rows() const
    {
      const auto cycles = columns.find("cycle");
      return cycles == columns.end() ? 0 : cycles->second.size();
    }
    /** The text of a cell; empty if there is no such row. */
    std::string
    word(const std::string &column, unsigned int row) const
    {
      const auto &cells = words.at(column);
      return row < cells.size() ? cells[row] : "";
    }
    /** Columns that no cycle fills are left out of the file. */
    bool
    has(const std::string &column) const
    {
      return columns.count(column) > 0;
    }
    /** No number if there is no such row. */
    double
    value(const std::string &column, unsigned int row) const
    {
      return row < n_rows() ? columns.at(column)[row] : std::nan("");
    }
    double
    last(const std::string &column) const
    {
      return n_rows() == 0 ? std::nan("") : value(column, n_rows() - 1);
    }
    /** Whether a column has two rows or more and falls from each to the next. */
    bool
    falls(const std::string &column) const
    {
      bool result = n_rows() > 1;
      for (unsigned int row = 1; row < n_rows(); ++row)
        result = result && value(column, row) < value(column, row - 1);
      return result;
    }
    /** Largest relative difference of the columns that do not tell the time; one may be
     * left @p out. */
    double
    distance(const Table &other, const std::string &out = "") const
    {
      if (n_rows() == 0 || n_rows() != other.n_rows())
        return 1e300;
      double largest = 0.;
      for (const auto &column : columns)
        if (column.first.find("seconds") != 0 && column.first.find("iterations") != 0
            && column.first != "algebraic_error_estimate" && column.first != out)
          for (unsigned int row = 0; row < n_rows(); ++row)
            {
              const double a = column.second[row], b = other.value(column.first, row);
              if (std::isnan(a) != std::isnan(b))
                return 1e300;
              if (a != b && !std::isnan(a))
                largest = std::max(largest, std::abs(a - b) / std::max(std::abs(a), std::abs(b)));
            }
      return largest;
    }

  private:
    /** No number for a word or nothing. */
    static double
    number(const std::string &cell)
    {
      char        *end   = nullptr;
      const double value = std::strtod(cell.c_str(), &end);
      return cell.empty() || *end != 0 ? std::nan("") : value;
    }

    std::map<std::string, std::vector<double>>      columns;
    std::map<std::string, std::vector<std::string>> words;
  };

  /** A folder that is not there, or was removed. */
  inline fs::path
  fresh(const std::string &name)
  {
    fs::remove_all(name);
    return name;
  }

  /** The table of a run of the scene @p text in a folder called @p name; what goes wrong is
   * printed. */
  inline Table
  table_of(const std::string &name, const std::string &text, const std::string &options)
  {
    write(name + ".prm", text);
    const fs::path folder = fresh(name);
    const auto     result
      = run("--quiet --output-directory " + name + " " + options + " " + name + ".prm");
    if (result.code != 0)
      std::cout << name << ": exit code " << result.code << '\n' << result.err;
    return Table(folder);
  }

  /** The section Mesh of a unit cube in bricks. */
  inline std::string
  bricks_section(const std::string &cells)
  {
    return "subsection Mesh\n set Type = bricks\n set Cells = " + cells + "\nend\n";
  }

  /** The rest of a scene: a material, a support at the bottom, a traction @p load at the top. */
  inline std::string
  loaded_block(const std::string &load)
  {
    return R"(
subsection Materials
  subsection m
    set Young modulus = 1000
  end
end
subsection Supports
  subsection s
    set Groups = z-min
  end
end
subsection Loads
  subsection l
    set Groups = z-max
    set Value  = )"
           + load + "\n  end\nend\n";
  }

  /** Names of the files in a folder, sorted, in one line, without the program's list. */
  inline std::string
  files(const fs::path &folder)
  {
    std::map<std::string, bool> names;
    if (fs::exists(folder))
      for (const auto &entry : fs::directory_iterator(folder))
        names[entry.path().filename().string()] = true;
    names.erase(".tetradapt-files");
    std::string text;
    for (const auto &name : names)
      text += (text.empty() ? "" : " ") + name.first;
    return text;
  }

  /** @p text without the working directory's name. */
  inline std::string
  portable(std::string text)
  {
    const std::string here = fs::current_path().string() + "/";
    for (auto at = text.find(here); at != std::string::npos; at = text.find(here))
      text.replace(at, here.size(), "");
    return text;
  }
} // namespace program

#endif

// A triangle mesh of a Wavefront OBJ file: its v and f lines; faces of more corners become fans. Stands for what an engine has loaded anyway.
#ifndef OBJ_MESH_HPP
#define OBJ_MESH_HPP

#include <array>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

struct ObjMesh {
  std::vector<std::array<double, 3>> vertices;  // m
  std::vector<std::array<std::uint32_t, 3>> triangles;

  static ObjMesh read(const std::string &path, double metres_per_unit) {
    std::ifstream file(path);
    if (!file)
      throw std::runtime_error(path + ": cannot be read");
    ObjMesh mesh;
    for (std::string line; std::getline(file, line);) {
      std::istringstream words(line);
      std::string kind;
      words >> kind;
      if (kind == "v") {
        std::array<double, 3> vertex{};
        if (!(words >> vertex[0] >> vertex[1] >> vertex[2]))
          throw std::runtime_error(path + ": a vertex without three numbers: " + line);
        for (double &number : vertex)
          number *= metres_per_unit;
        mesh.vertices.push_back(vertex);
      } else if (kind == "f") {
        std::vector<std::uint32_t> corners;
        for (std::string word; words >> word;) {
          const unsigned long index = std::stoul(word);  // of v/vt/vn the first
          if (index < 1 || index > mesh.vertices.size())
            throw std::runtime_error(path + ": a face of a vertex that is not there: " + line);
          corners.push_back(static_cast<std::uint32_t>(index - 1));
        }
        for (std::size_t i = 2; i < corners.size(); i++)
          mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
      }
    }
    if (mesh.triangles.empty())
      throw std::runtime_error(path + ": holds no faces");
    return mesh;
  }
};

#endif  // OBJ_MESH_HPP

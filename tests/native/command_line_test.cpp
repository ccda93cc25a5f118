// The command as a user meets it: what it prints where, its exit status, and what it leaves behind.
#include <nlohmann/json.hpp>
#include <vector>

#include "byte_string.h"
#include "command_line.h"
#include "mesh_io/mesh_file.h"
#include "shapes.h"

namespace isostar::native {
namespace {

TEST_F(CommandLine, helpsOnStandardOutput) {
  for (const char* command : {"", "encode", "decode", "info", "compare"}) {
    const Outcome outcome = run(*command ? std::vector<std::string>{command, "--help"}
                                         : std::vector<std::string>{"--help"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(outcome.results.find("Usage: isostar"), std::string::npos);
    EXPECT_EQ(outcome.words, "");
  }
  EXPECT_NE(run({"encode", "--help"}).results.find("=0.05"), std::string::npos)
      << "the default bound is shown";
}

TEST_F(CommandLine, tellsItsVersion) {
  const Outcome outcome = run({"--version"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.results.rfind("isostar ", 0), 0u);
}

TEST_F(CommandLine, refusesUnknownWordsAndSuggests) {
  EXPECT_NE(expectFault(2, {"encode", "a", "b", "--iso", "1", "--max-eror", "2"})
                .find("did you mean --max-error?"),
            std::string::npos);
  EXPECT_NE(expectFault(2, {"decode", "a", "b.ply", "--poligonizer=cubes"})
                .find("did you mean --polygonizer?"),
            std::string::npos);
  EXPECT_NE(expectFault(2, {"encod", "a"}).find("did you mean encode?"), std::string::npos);
  EXPECT_NE(expectFault(2, {"info", "a", "b"}).find("one argument too many: b"), std::string::npos);
  expectFault(2, {"decode", "a", "b.ply", "--zzz"});
  expectFault(2, {});
}

TEST_F(CommandLine, refusesValuesThatMakeNoSense) {
  const std::string volume = ball();
  for (const std::vector<std::string>& bad :
       std::vector<std::vector<std::string>>{{"--iso", "nan"},
                                             {"--iso", "inf"},
                                             {"--iso", "high"},
                                             {"--iso"},
                                             {},
                                             {"--iso", "0", "--max-error", "abc"},
                                             {"--iso", "0", "--max-error", "0"},
                                             {"--iso", "0", "--max-error", "-1"},
                                             {"--iso", "0", "--max-error", "nan"},
                                             {"--iso", "0", "--max-error", "0.1", "--lossless"},
                                             {"--iso", "0", "--adaptive", "--lossless"},
                                             {"--iso", "0", "--polygonizer", "spheres"},
                                             {"--iso", "0", "--units", "miles"},
                                             {"--iso", "0", "--size", "1,2"},
                                             {"--iso", "0", "--size", "1,2,x", "--type", "u8"},
                                             {"--iso", "0", "--size", "-1,2,3", "--type", "u8"},
                                             {"--iso", "0", "--type", "u9"},
                                             {"--iso", "0", "--size", "1,2,3"},
                                             {"--iso", "0", "--spacing", "0,1,1"},
                                             {"--iso", "0", "--spacing", "nan,1,1"}}) {
    std::vector<std::string> line = {"encode", volume, "out.isostar"};
    line.insert(line.end(), bad.begin(), bad.end());
    expectFault(2, line);
  }
  encodeBall();
  expectFault(2, {"decode", "ball.isostar", "out.ply", "--bytes", "-1"});
  expectFault(2, {"decode", "ball.isostar", "out.ply", "--level", "-1"});
  expectFault(2, {"decode", "ball.isostar", "out.ply", "--level", "1", "--bytes", "100"});
  expectFault(2, {"decode", "ball.isostar", "out.ply", "--frame", "moon"});
  expectFault(2, {"decode", "ball.isostar", "out.xyz"});
}

TEST_F(CommandLine, refusesFilesItCannotReadOrWrite) {
  const std::string volume = ball();
  EXPECT_NE(expectFault(1, {"encode", "none.nrrd", "out.isostar", "--iso", "0"})
                .find("none.nrrd: cannot be read"),
            std::string::npos);
  EXPECT_NE(expectFault(1, {"encode", volume, "none/out.isostar", "--iso", "0"})
                .find("there is no folder none"),
            std::string::npos);
  expectFault(1, {"encode", volume, ".", "--iso", "0"});
  expectFault(2, {"encode", volume, volume, "--iso", "0"});
  expectFault(2, {"encode", volume, "./ball.nrrd", "--iso", "0"});
  expectFault(1, {"decode", "none.isostar", "out.ply"});
  EXPECT_NE(expectFault(1, {"decode", volume, "out.ply"}).find("ball.nrrd: "), std::string::npos);
  expectFault(1, {"info", volume});
  expectFault(1, {"info", "none"});
  expectFault(1, {"compare", "none.ply", "none.ply"});
  EXPECT_FALSE(read(volume).empty());
}

TEST_F(CommandLine, encodesAClosedMesh) {
  const Mesh model = torus(30, 3, 1);
  for (const std::string name : {"model.ply", "model.obj", "model.stl", "model.glb"}) {
    writeMesh(model, path(name));
    const Outcome encoded = run({"encode", name, "model.isostar", "--grid", "65"});
    ASSERT_EQ(encoded.status, 0) << encoded.words;
    EXPECT_EQ(std::count(encoded.words.begin(), encoded.words.end(), '\n'), 1) << encoded.words;
    const Outcome compared = run({"compare", "model.isostar", name, "--json"});
    const auto report = nlohmann::json::parse(compared.results);
    EXPECT_LT(report["symmetric"]["max"].get<double>(), 0.3) << compared.results;
  }
  const Outcome info = run({"info", "model.isostar", "--json"});
  EXPECT_EQ(nlohmann::json::parse(info.results)["size"], (std::vector<int>{65, 65, 23}));
}

TEST_F(CommandLine, refusesMeshesWithoutASurface) {
  write("empty.obj", "v 0 0 0\n");
  EXPECT_NE(
      expectFault(1, {"encode", "empty.obj", "a.isostar"}).find("empty.obj: has no triangles"),
      std::string::npos);
  write("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 1\nf 1 2 3\n");
  EXPECT_NE(expectFault(1, {"encode", "nan.obj", "a.isostar"}).find("nan.obj: "),
            std::string::npos);
  writeMesh(torus(9, 3, 1), path("model.ply"));
  for (const std::vector<std::string>& bad :
       std::vector<std::vector<std::string>>{{"model.ply", "a.isostar", "--grid", "3"},
                                             {"model.ply", "a.isostar", "--grid", "many"},
                                             {"model.ply", "a.isostar", "--spacing", "1,1,1"},
                                             {ball(), "a.isostar", "--iso", "0", "--grid", "65"}}) {
    std::vector<std::string> line = {"encode"};
    line.insert(line.end(), bad.begin(), bad.end());
    expectFault(2, line);
  }
}

TEST_F(CommandLine, tellsThatAMeshIsNotClosed) {
  Mesh open = torus(30, 3, 1);
  open.indices.resize(open.indices.size() - 3);
  writeMesh(open, path("open.ply"));
  const Outcome outcome = run({"encode", "open.ply", "open.isostar", "--grid", "33"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.words.find("open.ply: not closed: 3 boundary edges; a majority vote of rays "
                               "decides what is inside\n"),
            std::string::npos)
      << outcome.words;
}

/// A tetrahedron whose scalar is x + 2 y, and a triangle.
std::string tetrahedronInText() {
  return "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n"
         "0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 2 9\n4 0 1 2 3\n3 0 1 2\nCELL_TYPES 2\n10\n5\n"
         "POINT_DATA 4\nSCALARS f float 1\nLOOKUP_TABLE default\n0 1 2 0\n";
}

TEST_F(CommandLine, encodesTetrahedra) {
  write("mesh.vtk", tetrahedronInText());
  const Outcome encoded =
      run({"encode", "mesh.vtk", "mesh.isostar", "--iso", "0.5", "--grid", "33"});
  if (encoded.words.find("reads no VTK files") != std::string::npos) GTEST_SKIP() << encoded.words;
  ASSERT_EQ(encoded.status, 0) << encoded.words;
  EXPECT_NE(encoded.words.find("mesh.vtk: cells that are not tetrahedra, left out: 1\n"),
            std::string::npos);
  EXPECT_NE(encoded.words.find("mesh.vtk: sampled at 33 x 33 x 33 points, up to "),
            std::string::npos);
  EXPECT_EQ(encoded.words.find("beyond the mesh's boundary"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(run({"info", "mesh.isostar", "--json"}).results)["trimmed"],
            true);
  EXPECT_NE(run({"info", "mesh.isostar"}).results.find("domain       ends inside the grid"),
            std::string::npos);
  const Outcome several = run(
      {"encode", "mesh.vtk", "several.isostar", "--iso", "0.5", "--near", "0.75", "--grid", "33"});
  EXPECT_EQ(several.status, 0) << several.words;
  EXPECT_NE(several.words.find("the surface continues beyond the mesh's boundary"),
            std::string::npos);
  for (const bool swapped : {false, true}) {
    std::vector<std::string> line = {"compare", "mesh.isostar", "mesh.vtk",
                                     "--iso",   "0.5",          "--json"};
    if (swapped) std::swap(line[1], line[2]);
    const auto report = nlohmann::json::parse(run(line).results);
    EXPECT_EQ(report["units"], "grid");
    EXPECT_LT(report["symmetric"]["max"].get<double>(), 0.5) << "of a flat surface, at its corners";
  }
}

TEST_F(CommandLine, inTheWorldTheBoundCountsFromTheTetrahedra) {
  write("mesh.vtk", tetrahedronInText());
  const Outcome encoded = run({"encode", "mesh.vtk", "mesh.isostar", "--iso", "0.5", "--max-error",
                               "0.01", "--units", "world"});
  if (encoded.words.find("reads no VTK files") != std::string::npos) GTEST_SKIP() << encoded.words;
  ASSERT_EQ(encoded.status, 0) << encoded.words;
  EXPECT_NE(encoded.words.find("error at most 0.01 world units"), std::string::npos)
      << encoded.words;
  const auto report = nlohmann::json::parse(
      run({"compare", "mesh.isostar", "mesh.vtk", "--iso", "0.5", "--units", "world", "--json"})
          .results);
  EXPECT_LE(report["symmetric"]["max"].get<double>(), 0.01);
}

TEST_F(CommandLine, refusesTetrahedraThatItCannotUse) {
  write("mesh.vtk", tetrahedronInText());
  expectFault(2, {"encode", "mesh.vtk", "a.isostar"});
  expectFault(2, {"encode", "mesh.vtk", "a.isostar", "--iso", "0", "--spacing", "1,1,1"});
  expectFault(2, {"encode", ball(), "a.isostar", "--iso", "0", "--scalar", "f"});
  expectFault(2, {"compare", "mesh.vtk", "mesh.vtk"});
  expectFault(1, {"encode", "none.vtu", "a.isostar", "--iso", "0"});
  expectFault(1, {"encode", "mesh.vtk", "a.isostar", "--iso", "0", "--scalar", "g"});
}

TEST_F(CommandLine, leavesAnOldOutputAloneWhereItFails) {
  ball();
  write("cut.nrrd", read("ball.nrrd").substr(0, 5000));
  write("out.isostar", "before");
  expectFault(1, {"encode", "cut.nrrd", "out.isostar", "--iso", "0"});
  EXPECT_EQ(read("out.isostar"), "before");
}

TEST_F(CommandLine, tellsThatStandardOutputIsFull) {
  encodeBall();
  EXPECT_EQ(run({"info", "ball.isostar", "--json"}, "/dev/full").status, 1);
  EXPECT_EQ(run({"encode", "ball.nrrd", "/dev/full", "--iso", "0"}).status, 1);
}

TEST_F(CommandLine, encodesTellsDecodesAndCompares) {
  const Outcome encoded = run({"encode", ball(), "ball.isostar", "--iso", "0", "--json"});
  ASSERT_EQ(encoded.status, 0) << encoded.words;
  const auto report = nlohmann::json::parse(encoded.results);
  EXPECT_EQ(report["bytes"], read("ball.isostar").size());
  EXPECT_GT(report["peakMemory"], 1 << 20);
  EXPECT_TRUE(report["milliseconds"]["encode"].is_number() &&
              report["milliseconds"]["polygonize"].is_number());
  EXPECT_NE(encoded.words.find("error at most 0.05 grid steps"), std::string::npos);

  const auto info = nlohmann::json::parse(run({"info", "ball.isostar", "--json"}).results);
  EXPECT_EQ(info["vertices"], report["vertices"]);
  EXPECT_EQ(info["size"], (std::vector<int>{20, 20, 20}));
  EXPECT_EQ(info["spacing"], (std::vector<double>{1, 1, 2}));
  EXPECT_EQ(info["isovalues"], (std::vector<double>{0}));
  EXPECT_EQ(info["layers"].back()["offset"], report["bytes"]);
  const auto& bits = info["bits"];
  EXPECT_EQ(
      bits["connectivity"].get<int>() + bits["geometry"].get<int>() + bits["header"].get<int>(),
      8 * report["bytes"].get<int>());

  const Outcome decoded = run({"decode", "ball.isostar", "ball.ply", "--json"});
  ASSERT_EQ(decoded.status, 0) << decoded.words;
  const Mesh mesh = readMesh(path("ball.ply"));
  const auto counts = nlohmann::json::parse(decoded.results);
  EXPECT_EQ(counts["vertices"], mesh.positions.size() / 3);
  EXPECT_EQ(counts["triangles"], mesh.indices.size() / 3);
  EXPECT_EQ(counts["vertices"], report["vertices"]);
  EXPECT_EQ(counts["triangles"], report["triangles"]);

  const Outcome compared = run({"compare", "ball.ply", "ball.isostar", "--json"});
  ASSERT_EQ(compared.status, 0) << compared.words;
  const auto distances = nlohmann::json::parse(compared.results);
  EXPECT_LT(distances["symmetric"]["max"], 1e-5);
  EXPECT_EQ(distances["a"]["components"], 1);
  EXPECT_EQ(distances["b"]["genus"], 0);
  EXPECT_EQ(distances["b"]["boundaryEdges"], 0);
  EXPECT_EQ(distances["units"], "grid");
}

TEST_F(CommandLine, writesEveryMeshFormatInBothFrames) {
  encodeBall();
  for (const char* name : {"m.ply", "m.obj", "m.stl", "m.glb"})
    EXPECT_EQ(run({"decode", "ball.isostar", name, "--polygonizer", "tetrahedra"}).status, 0)
        << name;
  run({"decode", "ball.isostar", "world.stl"});
  run({"decode", "ball.isostar", "grid.stl", "--frame", "grid"});
  const auto highest = [&](const char* name) {
    float z = 0;
    const Mesh mesh = readMesh(path(name));
    for (size_t v = 2; v < mesh.positions.size(); v += 3) z = std::max(z, mesh.positions[v]);
    return z;
  };
  EXPECT_NEAR(highest("world.stl"), 2 * highest("grid.stl"), 1e-4);
}

TEST_F(CommandLine, drawsTheContoursOfAnImage) {
  std::vector<float> samples;
  for (int j = 0; j < 20; ++j)
    for (int i = 0; i < 30; ++i)
      samples.push_back(static_cast<float>(6 - std::hypot(i - 9.6, j - 9.3)));
  write("disc.nrrd",
        "NRRD0004\ntype: float\ndimension: 2\nsizes: 30 20\nspacings: 2 2\nencoding: raw\nendian: "
        "little\n\n" +
            bytesOf(samples));
  ASSERT_EQ(
      run({"encode", "disc.nrrd", "disc.isostar", "--iso", "0", "--lossless", "--json"}).status, 0);
  EXPECT_EQ(nlohmann::json::parse(run({"info", "disc.isostar", "--json"}).results)["dimension"], 2);
  ASSERT_EQ(run({"decode", "disc.isostar", "disc.svg"}).status, 0);
  const std::string svg = read("disc.svg");
  EXPECT_NE(svg.find("viewBox=\"0 0 58 38\""), std::string::npos) << svg;
  EXPECT_EQ(std::count(svg.begin(), svg.end(), 'M'), 2) << "an area and its border\n" << svg;
  EXPECT_EQ(run({"decode", "disc.isostar", "grid.svg", "--frame", "grid", "--level", "0"}).status,
            0);
  EXPECT_NE(read("grid.svg").find("viewBox=\"0 0 29 19\""), std::string::npos);
  EXPECT_NE(expectFault(1, {"decode", "disc.isostar", "disc.ply"}).find("written as .svg"),
            std::string::npos);
  EXPECT_NE(expectFault(1, {"compare", "disc.isostar", "disc.isostar"}).find("no surface"),
            std::string::npos);
  encodeBall();
  EXPECT_NE(expectFault(1, {"decode", "ball.isostar", "ball.svg"}).find("holds a surface"),
            std::string::npos);
}

TEST_F(CommandLine, fillsWhatIsPositiveUpToTheBorder) {
  write("slope.nrrd",
        "NRRD0004\ntype: float\ndimension: 2\nsizes: 3 2\nencoding: raw\nendian: little\n\n" +
            bytesOf(std::vector<float>{-1, 1, 3, -1, 1, 3}));
  ASSERT_EQ(run({"encode", "slope.nrrd", "slope.isostar", "--iso", "0", "--lossless"}).status, 0);
  ASSERT_EQ(run({"decode", "slope.isostar", "slope.svg"}).status, 0);
  EXPECT_NE(read("slope.svg").find("d=\"M0.5 1L0.5 0L2 0L2 1Z\""), std::string::npos)
      << read("slope.svg");
  ASSERT_EQ(run({"encode", "slope.nrrd", "white.isostar", "--iso", "-2"}).status, 0);
  ASSERT_EQ(run({"decode", "white.isostar", "white.svg"}).status, 0);
  EXPECT_NE(read("white.svg").find("d=\"M0 0L2 0L2 1L0 1Z\""), std::string::npos)
      << read("white.svg");
}

TEST_F(CommandLine, cutsASequenceAtATime) {
  std::vector<float> samples;
  for (int t = 0; t < 4; ++t)
    for (int k = 0; k < 12; ++k)
      for (int j = 0; j < 12; ++j)
        for (int i = 0; i < 12; ++i)
          samples.push_back(static_cast<float>(2 + t - std::hypot(i - 5.6, j - 5.3, k - 5.5)));
  write(
      "balls.nrrd",
      "NRRD0004\ntype: float\ndimension: 4\nsizes: 12 12 12 4\nencoding: raw\nendian: little\n\n" +
          bytesOf(samples));
  ASSERT_EQ(run({"encode", "balls.nrrd", "balls.isostar", "--iso", "0"}).status, 0);
  const auto highest = [&](const std::string& time) {
    EXPECT_EQ(run({"decode", "balls.isostar", "cut.ply", "--time", time}).status, 0);
    float z = 0;
    const Mesh mesh = readMesh(path("cut.ply"));
    for (size_t v = 2; v < mesh.positions.size(); v += 3) z = std::max(z, mesh.positions[v]);
    return z;
  };
  EXPECT_NEAR(highest("0"), 7.5, 0.1);
  EXPECT_NEAR(highest("1.5"), 9, 0.15);
  EXPECT_NEAR(highest("3"), 10.5, 0.1);
  EXPECT_NE(
      expectFault(1, {"decode", "balls.isostar", "x.ply", "--time", "3.01"}).find("frames 0 to 3"),
      std::string::npos);
  encodeBall();
  EXPECT_NE(
      expectFault(1, {"decode", "ball.isostar", "x.ply", "--time", "0"}).find("not a sequence"),
      std::string::npos);
}

TEST_F(CommandLine, decodesPrefixes) {
  encodeBall();
  const auto info = nlohmann::json::parse(run({"info", "ball.isostar", "--json"}).results);
  const auto report = [&](std::vector<std::string> more) {
    std::vector<std::string> line = {"decode", "ball.isostar", "part.ply", "--json"};
    line.insert(line.end(), more.begin(), more.end());
    const Outcome outcome = run(line);
    EXPECT_EQ(outcome.status, 0) << outcome.words;
    EXPECT_EQ(outcome.words.find("warning"), std::string::npos) << outcome.words;
    return nlohmann::json::parse(outcome.results);
  };
  EXPECT_LT(report({"--level", "0"})["vertices"], info["vertices"]);
  EXPECT_EQ(report({"--level", "99"})["vertices"], info["vertices"]);
  EXPECT_EQ(report({"--bytes", "99999999"})["vertices"], info["vertices"]);
  const int whole = info["bytes"], header = info["bits"]["header"].get<int>() / 8;
  for (int bytes = header; bytes < whole; bytes += 1 + whole / 20)
    report({"--bytes", std::to_string(bytes)});
  expectFault(1, {"decode", "ball.isostar", "part2.ply", "--bytes", "3"});
}

TEST_F(CommandLine, warnsOfAFileThatEndsEarly) {
  encodeBall();
  const std::string whole = read("ball.isostar");
  write("cut.isostar", whole.substr(0, whole.size() - 10));
  const Outcome outcome = run({"decode", "cut.isostar", "cut.ply"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.words.find("warning: cut.isostar ends early"), std::string::npos)
      << outcome.words;
}

TEST_F(CommandLine, refusesADamagedStream) {
  encodeBall();
  std::string stream = read("ball.isostar");
  stream[stream.size() / 2] ^= 0x10;
  write("bad.isostar", stream);
  expectFault(1, {"decode", "bad.isostar", "bad.ply"});
}

TEST_F(CommandLine, refusesAnIsovalueTheStreamDoesNotHold) {
  encodeBall();
  EXPECT_NE(expectFault(1, {"decode", "ball.isostar", "out.ply", "--iso", "1"})
                .find("does not hold isovalue 1"),
            std::string::npos);
  EXPECT_EQ(run({"decode", "ball.isostar", "out.ply", "--iso", "0"}).status, 0);
}

TEST_F(CommandLine, severalIsovaluesInAFile) {
  ASSERT_EQ(run({"encode", ball(), "several.isostar", "--iso", "0", "--near", "0.5,-0.25"}).status,
            0);
  ASSERT_EQ(run({"encode", ball(), "half.isostar", "--iso", "0.5"}).status, 0);
  const auto info = nlohmann::json::parse(run({"info", "several.isostar", "--json"}).results);
  EXPECT_EQ(info["isovalues"], (std::vector<double>{0, -0.25, 0.5}));
  EXPECT_EQ(info["layers"].front()["isovalue"], 0);
  EXPECT_EQ(info["layers"].back()["isovalue"], 0.5);
  const auto compared = nlohmann::json::parse(
      run({"compare", "several.isostar", "half.isostar", "--iso", "0.5", "--json"}).results);
  EXPECT_LT(compared["symmetric"]["max"], 0.1);
  EXPECT_EQ(compared["a"]["vertices"], compared["b"]["vertices"]);
  for (const char* isovalue : {"0", "-0.25", "0.5", "0.3"}) {
    EXPECT_EQ(run({"decode", "several.isostar", "out.ply", "--iso", isovalue}).status, 0)
        << isovalue;
  }
  const std::string fault =
      expectFault(1, {"decode", "several.isostar", "out.ply", "--iso", "0.6"});
  EXPECT_NE(fault.find("it holds 0, -0.25, 0.5 and values in between"), std::string::npos) << fault;
  for (const char* bad : {"0", "1,1", "nan", "1,inf", "1,x", ""})
    expectFault(2, {"encode", ball(), "x.isostar", "--iso", "0", "--near", bad});
  expectFault(2, {"encode", ball(), "x.isostar", "--iso", "0", "--near", "1", "--adaptive"});
  expectFault(2, {"encode", ball(), "x.isostar", "--iso", "0", "--near",
                  "1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16"});
}

TEST_F(CommandLine, takesNegativeIsovalues) {
  EXPECT_EQ(run({"encode", ball(), "a.isostar", "--iso", "-1.5"}).status, 0);
  EXPECT_EQ(run({"encode", ball(), "a.isostar", "--iso=-1.5"}).status, 0);
}

TEST_F(CommandLine, anEmptySurfaceIsAStreamAndAWarning) {
  const Outcome outcome = run({"encode", ball(), "empty.isostar", "--iso", "1000"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.words.find("warning: the surface is empty"), std::string::npos);
  for (const char* name : {"e.ply", "e.obj", "e.stl", "e.glb"})
    EXPECT_EQ(run({"decode", "empty.isostar", name}).status, 0);
  EXPECT_EQ(run({"info", "empty.isostar"}).status, 0);
  EXPECT_TRUE(nlohmann::json::parse(
                  run({"compare", "e.ply", "empty.isostar", "--json"}).results)["symmetric"]
                  .is_null());
}

TEST_F(CommandLine, aBoundFinerThanTheDataSaysSo) {
  write("v.raw", bytesOf(counting<uint8_t>(125)));
  const std::vector<std::string> encode{"encode", "v.raw", "v.isostar", "--size", "5,5,5",
                                        "--type", "u8",    "--iso",     "60.5",   "--max-error"};
  const auto wordsAt = [&](const char* bound) {
    auto arguments = encode;
    arguments.push_back(bound);
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.words;
    return outcome.words;
  };
  EXPECT_NE(wordsAt("0.001").find("finer than the data"), std::string::npos);
  EXPECT_EQ(wordsAt("0.6").find("finer than the data"), std::string::npos);
}

TEST_F(CommandLine, streamsSayThatTheyTakeMoreEffort) {
  ASSERT_EQ(run({"encode", ball(), "a.isostar", "--iso", "0", "--effort", "2"}).status, 0);
  EXPECT_EQ(
      nlohmann::json::parse(run({"info", "a.isostar", "--json"}).results)["effort"].get<int>(), 2);
  EXPECT_NE(run({"info", "a.isostar"}).results.find("effort       2"), std::string::npos);
  expectFault(2, {"encode", ball(), "x.isostar", "--iso", "0", "--effort", "3"});
}

TEST_F(CommandLine, streamsOfOneTopologySayThatTheyAre) {
  const Outcome outcome = run({"encode", ball(), "a.isostar", "--iso", "0", "--preserve-topology"});
  EXPECT_EQ(outcome.status, 0) << outcome.words;
  EXPECT_TRUE(
      nlohmann::json::parse(run({"info", "a.isostar", "--json"}).results)["preservesTopology"]
          .get<bool>());
  EXPECT_NE(run({"info", "a.isostar"}).results.find("the same in every layer"), std::string::npos);
  EXPECT_NE(run({"encode", ball(), "a.isostar", "--iso", "0", "--preserve-topology", "--adaptive"})
                .words.find("--adaptive"),
            std::string::npos);
}

/// A volume of 130 x 40 x 70 samples, of which a stream has several chunks of 64.
class CommandWithChunks : public CommandLine {
 protected:
  void writeWaves() const {
    std::vector<float> samples;
    for (int k = 0; k < 70; ++k)
      for (int j = 0; j < 40; ++j)
        for (int i = 0; i < 130; ++i)
          samples.push_back(
              static_cast<float>(std::sin(i / 5.) + std::cos(j / 4.) + std::sin(k / 6.)));
    write("waves.nrrd",
          "NRRD0004\ntype: float\ndimension: 3\nsizes: 130 40 70\nencoding: raw\n"
          "endian: little\n\n" +
              bytesOf(samples));
  }
};

TEST_F(CommandWithChunks, bytesDoNotDependOnThreads) {
  writeWaves();
  const std::vector<std::string> encode{"encode", "waves.nrrd", "x.isostar", "--iso",
                                        "0.3",    "--chunk",    "64",        "--threads"};
  std::string expected, mesh;
  for (const char* threads : {"1", "2", "3", "7"}) {
    auto arguments = encode;
    arguments.emplace_back(threads);
    ASSERT_EQ(run(arguments).status, 0);
    ASSERT_EQ(run({"decode", "x.isostar", "x.ply", "--threads", threads}).status, 0);
    if (expected.empty()) expected = read("x.isostar"), mesh = read("x.ply");
    EXPECT_EQ(read("x.isostar"), expected) << threads;
    EXPECT_EQ(read("x.ply"), mesh) << threads;
  }
  EXPECT_NE(run({"info", "x.isostar"}).results.find("64 cells"), std::string::npos);
  expectFault(2, {"encode", "waves.nrrd", "y.isostar", "--iso", "0.3", "--chunk", "60"});
  expectFault(2, {"decode", "x.isostar", "y.ply", "--threads", "0"});
}

TEST_F(CommandWithChunks, decodesRegionsAndReadsNoMore) {
  writeWaves();
  ASSERT_EQ(run({"encode", "waves.nrrd", "x.isostar", "--iso", "0.3", "--chunk", "64"}).status, 0);
  const auto decoded = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"decode", "x.isostar", "x.stl", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.words;
    return nlohmann::json::parse(outcome.results);
  };
  const auto whole = decoded({});
  const auto part = decoded({"--region", "-5,-5,-5,20,20,20"});
  EXPECT_LT(part["bytes"], whole["bytes"]);
  const auto all = decoded({"--region=0,0,0,1e6,1e6,1e6", "--frame", "grid"});
  for (const char* key : {"bytes", "vertices", "triangles"}) EXPECT_EQ(all[key], whole[key]);
  for (const char* words : {"1,2,3", "0,0,0,1,1,-1", "0,0,0,1,1,nan", "0,0,0,1,1,1,1"})
    expectFault(2, {"decode", "x.isostar", "y.stl", "--region", words});
  expectFault(2, {"decode", "x.isostar", "y.stl", "--region", "0,0,0,1,1,1", "--level", "2"});
}

TEST_F(CommandLine, saysWhatIsForVolumesOnly) {
  write("sequence.nrrd",
        "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 5 5 5 2\nkinds: domain domain domain "
        "time\nencoding: raw\n\n" +
            bytesOf(counting<uint8_t>(250)));
  EXPECT_EQ(run({"encode", "sequence.nrrd", "a.isostar", "--iso", "60.5"}).status, 0);
  EXPECT_NE(expectFault(
                1, {"encode", "sequence.nrrd", "x.isostar", "--iso", "60.5", "--preserve-topology"})
                .find("this is a sequence"),
            std::string::npos);
  EXPECT_NE(expectFault(1, {"encode", "sequence.nrrd", "x.isostar", "--iso", "60.5", "--adaptive"})
                .find("not for sequences"),
            std::string::npos);
}

TEST_F(CommandLine, readsRawAndWritesToAPipe) {
  write("v.raw", bytesOf(counting<uint8_t>(125)));
  const Outcome outcome =
      run({"encode", "v.raw", "-", "--size", "5,5,5", "--type", "u8", "--iso", "60.5"});
  EXPECT_EQ(outcome.status, 0) << outcome.words;
  write("v.isostar", outcome.results);
  EXPECT_EQ(run({"info", "v.isostar"}).status, 0);
}

TEST_F(CommandLine, countsLengthsInWorldUnits) {
  write("v.raw", bytesOf(counting<uint8_t>(125)));
  EXPECT_EQ(run({"encode", "v.raw", "v.isostar", "--size", "5,5,5", "--type", "u8", "--iso", "60.5",
                 "--spacing", "0.5,1,1", "--units", "world", "--max-error", "0.1"})
                .status,
            0);
  EXPECT_NEAR(nlohmann::json::parse(run({"info", "v.isostar", "--json"}).results)["maxError"], 0.2,
              1e-6);
  EXPECT_NEAR(nlohmann::json::parse(
                  run({"info", "v.isostar", "--json", "--units", "world"}).results)["maxError"],
              0.1, 1e-6);
}

}  // namespace
}  // namespace isostar::native

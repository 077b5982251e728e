// SPDX-License-Identifier: MIT
#include "touchstone/tools/case_file.h"

#include <fstream>
#include <ostream>
#include <sstream>
#include <vector>

#include "touchstone/tools/numbers.h"
#include "touchstone/tools/words.h"

namespace touchstone {
namespace {

constexpr std::string_view kMagic = "touchstone-case";
constexpr int kVersion = 1;
// A face or body line may announce no more than this.
constexpr int kMaxElements = 10'000'000;

// Decimals where they are short, for a reader; the shortest decimal reads back as the same double.
std::string Number(double value) {
  constexpr std::size_t kShort = 10;
  std::string decimal = ShortDouble(value);
  return decimal.size() <= kShort ? decimal : HexDouble(value);
}

void WriteRows(std::ostream& out, const Eigen::Matrix3d& rotation,
               const Eigen::Vector3d& translation) {
  for (int i = 0; i < 3; ++i) {
    out << "row";
    for (int j = 0; j < 3; ++j) out << ' ' << Number(rotation(i, j));
    out << ' ' << Number(translation[i]) << '\n';
  }
}

void WritePose(std::ostream& out, const RelativePose& pose) {
  if (pose.world()) {
    out << "pose world\n";
    WriteRows(out, pose.world()->first.rotation, pose.world()->first.translation);
    WriteRows(out, pose.world()->second.rotation, pose.world()->second.translation);
  } else {
    out << "pose relative\n";
    WriteRows(out, pose.rotation(), pose.translation());
  }
}

void WriteBody(std::ostream& out, std::string_view name, const ConvexPolyhedron& body) {
  out << "body " << name << ' ' << body.vertex_count() << ' ' << body.face_count() << '\n';
  for (const Eigen::Vector3d& v : body.vertices()) {
    out << "v " << Number(v[0]) << ' ' << Number(v[1]) << ' ' << Number(v[2]) << '\n';
  }
  for (int f = 0; f < body.face_count(); ++f) {
    out << 'f';
    for (const int v : body.face(f)) out << ' ' << v;
    out << '\n';
  }
}

std::string OneLine(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  return text;
}

// Thrown and caught within ReadCase: the line says what is wrong with it.
struct BadLine {
  std::string message;
};

class Reader {
 public:
  explicit Reader(std::istream& in) : in_(in) {}

  int line_number() const { return line_number_; }

  CaseFile Read() {
    ReadMagic();
    Header header;
    while (NextLine() && words_[0] != "pose") ReadHeaderLine(header);
    const RelativePose pose = ReadPose();
    ConvexPolyhedron p = ReadBody("p");
    ConvexPolyhedron q = ReadBody("q");
    Next("end");
    return {header.suite,   header.seed,      header.index,
            header.search,  header.certainty, header.early_exit,
            header.finding, header.detail,    {std::move(p), std::move(q), pose, header.expected},
            header.engine};
  }

 private:
  struct Header {
    std::string suite = "none";
    std::uint64_t seed = 0, index = 0;
    Search search = Search::kPortal;
    Certainty certainty = Certainty::kExact;
    bool early_exit = false;
    std::string finding = "none", detail, engine;
    std::optional<Verdict> expected;
  };

  [[noreturn]] void Fail(const std::string& message) const { throw BadLine{message}; }

  // The words of the next line that is neither empty nor a comment.
  bool NextLine() {
    while (std::getline(in_, line_)) {
      ++line_number_;
      words_.clear();
      std::istringstream split(line_);
      for (std::string word; split >> word;) words_.push_back(word);
      if (!words_.empty() && words_[0][0] != '#') return true;
    }
    ++line_number_;
    words_ = {""};
    return false;
  }

  // The next line must start with `keyword`.
  void Next(std::string_view keyword) {
    if (!NextLine()) Fail("the file ends where '" + std::string(keyword) + "' should be");
    Expect(keyword);
  }
  void Expect(std::string_view keyword) const {
    if (words_[0] != keyword)
      Fail("'" + words_[0] + "' where '" + std::string(keyword) + "' should be");
  }
  void ExpectWords(std::size_t count) const {
    if (words_.size() != count) {
      Fail("'" + words_[0] + "' takes " + std::to_string(count - 1) + " words, not " +
           std::to_string(words_.size() - 1));
    }
  }

  template <class Value>
  Value Need(const std::optional<Value>& value, const std::string& word) const {
    if (!value) Fail("'" + word + "' is not a value for '" + words_[0] + "'");
    return *value;
  }
  double Double(std::size_t k) const { return Need(ParseDouble(words_[k]), words_[k]); }
  int Int(std::size_t k) const { return Need(ParseInteger<int>(words_[k]), words_[k]); }

  void ReadMagic() {
    if (!NextLine() || words_[0] != kMagic)
      Fail("not a case file: it must begin with '" + std::string(kMagic) + " 1'");
    ExpectWords(2);
    if (Int(1) != kVersion)
      Fail("version " + words_[1] + " is unknown; this program reads version 1");
  }

  void ReadHeaderLine(Header& header) {
    const std::string& keyword = words_[0];
    if (keyword == "finding") {
      if (words_.size() < 2) Fail("'finding' takes a kind");
      header.finding = words_[1];
      for (std::size_t k = 2; k < words_.size(); ++k) {
        header.detail += (k == 2 ? "" : " ") + words_[k];
      }
      return;
    }
    ExpectWords(2);
    const std::string& word = words_[1];
    if (keyword == "suite") {
      header.suite = word;
    } else if (keyword == "engine") {
      header.engine = word;
    } else if (keyword == "seed") {
      header.seed = Need(ParseInteger<std::uint64_t>(word), word);
    } else if (keyword == "index") {
      header.index = Need(ParseInteger<std::uint64_t>(word), word);
    } else if (keyword == "search") {
      header.search = Need(SearchFromWord(word), word);
    } else if (keyword == "certainty") {
      header.certainty = Need(CertaintyFromWord(word), word);
    } else if (keyword == "expected") {
      header.expected = Need(VerdictFromWord(word), word);
    } else if (keyword == "early-exit" && (word == "yes" || word == "no")) {
      header.early_exit = word == "yes";
    } else if (keyword == "early-exit") {
      Fail("'early-exit' takes yes or no");
    } else {
      Fail("unknown keyword '" + keyword + "'");
    }
  }

  WorldPose ReadRows() {
    WorldPose pose;
    for (int i = 0; i < 3; ++i) {
      Next("row");
      ExpectWords(5);
      for (int j = 0; j < 3; ++j) pose.rotation(i, j) = Double(1 + j);
      pose.translation[i] = Double(4);
    }
    return pose;
  }

  RelativePose ReadPose() {
    Expect("pose");
    ExpectWords(2);
    const bool world = words_[1] == "world";
    if (!world && words_[1] != "relative") Fail("'pose' takes relative or world");
    const WorldPose first = ReadRows();
    const StatusOr<RelativePose> pose = world
                                            ? RelativePose::FromWorld(first, ReadRows())
                                            : RelativePose::Make(first.rotation, first.translation);
    if (!pose.ok()) Fail("the pose that ends here: " + pose.status().ToString());
    return *pose;
  }

  ConvexPolyhedron ReadBody(std::string_view name) {
    Next("body");
    ExpectWords(4);
    if (words_[1] != name)
      Fail("body '" + words_[1] + "' where body '" + std::string(name) + "' should be");
    const int vertex_count = Int(2);
    const int face_count = Int(3);
    if (vertex_count < 0 || vertex_count > kMaxElements || face_count < 0 ||
        face_count > kMaxElements) {
      Fail("no body has that many vertices and faces");
    }
    std::vector<Eigen::Vector3d> vertices;
    for (int v = 0; v < vertex_count; ++v) {
      Next("v");
      ExpectWords(4);
      vertices.emplace_back(Double(1), Double(2), Double(3));
    }
    std::vector<std::vector<int>> faces;
    for (int f = 0; f < face_count; ++f) {
      Next("f");
      std::vector<int>& loop = faces.emplace_back();
      for (std::size_t k = 1; k < words_.size(); ++k) loop.push_back(Int(k));
    }
    StatusOr<ConvexPolyhedron> body = ConvexPolyhedron::Build(vertices, faces);
    if (!body.ok())
      Fail("body " + std::string(name) + ", which ends here: " + body.status().ToString());
    return *body;
  }

  std::istream& in_;
  int line_number_ = 0;
  std::string line_;
  std::vector<std::string> words_;
};

}  // namespace

void WriteCase(std::ostream& out, const CaseFile& query) {
  out << kMagic << ' ' << kVersion << '\n' << "# Replay with: touchstone replay THIS_FILE\n";
  for (const std::string& line : query.caption) out << "# " << OneLine(line) << '\n';
  out << "suite " << query.suite << '\n'
      << "seed " << query.seed << '\n'
      << "index " << query.index << '\n'
      << "search " << ToString(query.search) << '\n'
      << "certainty " << ToString(query.certainty) << '\n'
      << "early-exit " << (query.early_exit ? "yes" : "no") << '\n'
      << "finding " << query.finding << ' ' << OneLine(query.detail) << '\n';
  if (!query.engine.empty()) out << "engine " << query.engine << '\n';
  if (query.pair.expected) out << "expected " << ToString(*query.pair.expected) << '\n';
  WritePose(out, query.pair.pose);
  WriteBody(out, "p", query.pair.p);
  WriteBody(out, "q", query.pair.q);
  out << "end\n";
}

Loaded<CaseFile> ReadCase(const std::string& path) {
  std::ifstream in(path);
  if (!in) return Loaded<CaseFile>::Error(path + ": cannot be opened");
  Reader reader(in);
  try {
    return reader.Read();
  } catch (const BadLine& bad) {
    return Loaded<CaseFile>::Error(path + ":" + std::to_string(reader.line_number()) + ": " +
                                   bad.message);
  }
}

}  // namespace touchstone

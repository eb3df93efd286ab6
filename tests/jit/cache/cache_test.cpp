// The cache holds executable code: nothing doubtful may come out of it.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "jit/cache/kernel_cache.h"
#include "tests/support/random.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

const std::string interface = "ff/f/f/0";

class Cache : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "nacre-cache-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    root_ = name;
    folder_ = root_ / "kernels";
  }
  void TearDown() override { fs::remove_all(root_); }

  std::unique_ptr<KernelCache> open(std::uint64_t limit = KernelCache::default_limit) {
    return KernelCache::open(folder_, diagnostics_, limit);
  }
  static ObjectCode object(std::size_t size = 3000) {
    ObjectCode made{"entry", interface, std::vector<char>(size)};
    Random random(size);
    for (char& byte : made.bytes) byte = static_cast<char>(random.word());
    return made;
  }
  fs::path file(const std::string& key) const { return folder_ / KernelCache::file_name(key); }

  static std::string read(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  static void write(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
    chmod(path.c_str(), S_IRUSR | S_IWUSR);
  }
  /// A fresh cache finds nothing under `key`, and says so once.
  void expect_refused(const std::string& key) {
    Diagnostics said;
    const auto cache = KernelCache::open(folder_, said);
    ASSERT_NE(cache, nullptr);
    EXPECT_FALSE(cache->load(key, interface, said).has_value());
    EXPECT_FALSE(cache->load(key, interface, said).has_value());
    ASSERT_EQ(said.all().size(), 1u);
    EXPECT_EQ(said.all().front().code, "kernel-cache");
    EXPECT_EQ(said.error_count(), 0u);
  }

  fs::path root_;
  fs::path folder_;
  Diagnostics diagnostics_;
};

TEST_F(Cache, GivesBackWhatWasStored) {
  const ObjectCode stored = object();
  open()->store("key", stored, diagnostics_);
  const auto found = open()->load("key", interface, diagnostics_);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->symbol, stored.symbol);
  EXPECT_EQ(found->bytes, stored.bytes);
  EXPECT_FALSE(open()->load("another key", interface, diagnostics_).has_value());
  EXPECT_TRUE(diagnostics_.all().empty());
}

TEST_F(Cache, CreatesItsFolderForTheOwnerAlone) {
  open()->store("key", object(), diagnostics_);
  EXPECT_EQ(fs::status(folder_).permissions(), fs::perms::owner_all);
  EXPECT_EQ(fs::status(file("key")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(Cache, RefusesTruncatedFiles) {
  open()->store("key", object(), diagnostics_);
  const std::string whole = read(file("key"));
  for (std::size_t size = 0; size < whole.size(); size += 64) {
    SCOPED_TRACE(size);
    write(file("key"), whole.substr(0, size));
    expect_refused("key");
  }
  write(file("key"), whole + '\0');
  expect_refused("key");
}

TEST_F(Cache, RefusesFlippedBits) {
  open()->store("key", object(600), diagnostics_);
  const std::string whole = read(file("key"));
  Random random(7);
  for (int k = 0; k < 1500; ++k) {
    // The head bit by bit, the rest at random.
    const std::size_t bit = k < 512 ? static_cast<std::size_t>(k)
                                    : random.below(static_cast<std::uint32_t>(8 * whole.size()));
    SCOPED_TRACE(bit);
    std::string flipped = whole;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
    write(file("key"), flipped);
    expect_refused("key");
  }
}

TEST_F(Cache, ComparesTheWholeKey) {
  // A file that is sound but of another key, under the name of this one: as if
  // the digests of two keys were equal.
  open()->store("version 1", object(), diagnostics_);
  fs::copy_file(file("version 1"), file("version 2"));
  expect_refused("version 2");
}

TEST_F(Cache, ComparesTheInterface) {
  ObjectCode other = object();
  other.interface = "ff/f/f/1";
  open()->store("key", other, diagnostics_);
  EXPECT_FALSE(open()->load("key", interface, diagnostics_).has_value());
  ASSERT_EQ(diagnostics_.warning_count(), 1u);
}

TEST_F(Cache, RefusesWhatIsNotSignedWithItsSecret) {
  // Sound files of another folder, and so of another secret: as if somebody could write here.
  open()->store("key", object(), diagnostics_);
  const fs::path elsewhere = root_ / "elsewhere";
  Diagnostics said;
  KernelCache::open(elsewhere, said)->store("key", object(), said);
  ASSERT_NE(read(elsewhere / ".secret"), read(folder_ / ".secret"));
  fs::copy_file(elsewhere / KernelCache::file_name("key"), file("key"),
                fs::copy_options::overwrite_existing);
  expect_refused("key");
  EXPECT_EQ(said.to_string(), "");
}

TEST_F(Cache, KeepsItsSecret) {
  open()->store("key", object(), diagnostics_);
  const fs::path secret = folder_ / ".secret";
  EXPECT_EQ(fs::status(secret).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(fs::file_size(secret), 32u);
  const std::string bytes = read(secret);
  open(1)->store("another", object(), diagnostics_);  // Sweeps everything away.
  EXPECT_EQ(read(secret), bytes);
  // What others may know, and what is not whole, signs nothing.
  chmod(secret.c_str(), 0640);
  EXPECT_EQ(open(), nullptr);
  write(secret, bytes.substr(1));
  EXPECT_EQ(open(), nullptr);
  EXPECT_EQ(diagnostics_.warning_count(), 2u);
  write(secret, bytes);
  EXPECT_NE(open(), nullptr);
}

TEST_F(Cache, ThoseWhoComeFirstAgreeOnTheSecret) {
  std::vector<std::thread> threads;
  std::vector<Diagnostics> said(8);
  for (std::size_t t = 0; t < said.size(); ++t) {
    threads.emplace_back([&, t] {
      const auto cache = KernelCache::open(folder_, said[t]);
      cache->store("key " + std::to_string(t), object(), said[t]);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t t = 0; t < said.size(); ++t) {
    EXPECT_TRUE(open()->load("key " + std::to_string(t), interface, said[t]).has_value());
    EXPECT_EQ(said[t].to_string(), "");
  }
}

TEST_F(Cache, RefusesWhatOthersCanWrite) {
  open()->store("key", object(), diagnostics_);
  chmod(file("key").c_str(), 0620);
  expect_refused("key");
  chmod(file("key").c_str(), 0602);
  expect_refused("key");
  chmod(file("key").c_str(), 0600);
  EXPECT_TRUE(open()->load("key", interface, diagnostics_).has_value());
  for (const mode_t mode : {0720u, 0702u, 0777u}) {
    chmod(folder_.c_str(), mode);
    Diagnostics said;
    EXPECT_EQ(KernelCache::open(folder_, said), nullptr);
    EXPECT_EQ(said.warning_count(), 1u);
  }
}

TEST_F(Cache, RefusesWhatBelongsToOthers) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give files away";
  open()->store("key", object(), diagnostics_);
  ASSERT_EQ(chown(file("key").c_str(), 12345, 12345), 0);
  expect_refused("key");
  ASSERT_EQ(chown(folder_.c_str(), 12345, 12345), 0);
  Diagnostics said;
  EXPECT_EQ(KernelCache::open(folder_, said), nullptr);
  EXPECT_EQ(said.warning_count(), 1u);
}

TEST_F(Cache, FollowsNoLinks) {
  open()->store("key", object(), diagnostics_);
  fs::rename(file("key"), root_ / "elsewhere");
  fs::create_symlink(root_ / "elsewhere", file("key"));
  expect_refused("key");
  fs::rename(folder_, root_ / "real");
  fs::create_directory_symlink(root_ / "real", folder_);
  Diagnostics said;
  EXPECT_EQ(KernelCache::open(folder_, said), nullptr);
  EXPECT_EQ(said.warning_count(), 1u);
}

TEST_F(Cache, RefusesFoldersAndPipesInPlaceOfFiles) {
  ASSERT_NE(open(), nullptr);
  ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
  expect_refused("pipe");
  fs::create_directory(file("folder"));
  expect_refused("folder");
}

TEST_F(Cache, FileInPlaceOfTheFolderIsAWarning) {
  write(folder_, "not a folder");
  EXPECT_EQ(open(), nullptr);
  EXPECT_EQ(diagnostics_.warning_count(), 1u);
  EXPECT_EQ(diagnostics_.error_count(), 0u);
}

TEST_F(Cache, WarnsOnceIfItCanNotStore) {
  const auto cache = open();
  fs::remove_all(folder_);  // The folder is gone while it is open.
  cache->store("a", object(), diagnostics_);
  cache->store("b", object(), diagnostics_);
  EXPECT_EQ(diagnostics_.warning_count(), 1u);
  EXPECT_FALSE(cache->load("a", interface, diagnostics_).has_value());
}

TEST_F(Cache, LeastRecentlyUsedGo) {
  const auto cache = open(100000);
  const auto stored_at = [&](const std::string& key, int second) {
    cache->store(key, object(20000), diagnostics_);
    const timespec times[2]{{second, 0}, {second, 0}};
    utimensat(AT_FDCWD, file(key).c_str(), times, 0);
  };
  for (int k = 0; k < 4; ++k) stored_at("key " + std::to_string(k), 1000 + k);
  EXPECT_TRUE(cache->load("key 0", interface, diagnostics_).has_value());  // Now the newest.
  for (int k = 4; k < 6; ++k) stored_at("key " + std::to_string(k), 1000 + k);
  EXPECT_TRUE(fs::exists(file("key 0")));
  EXPECT_FALSE(fs::exists(file("key 1")));
  EXPECT_TRUE(fs::exists(file("key 5")));
  std::uintmax_t total = 0;
  for (const auto& entry : fs::directory_iterator(folder_)) total += entry.file_size();
  EXPECT_LE(total, 100000u);
}

TEST_F(Cache, ReadersSeeWholeFilesWhileWritersReplaceThem) {
  ASSERT_NE(open(), nullptr);
  std::vector<std::thread> threads;
  std::vector<Diagnostics> said(16);
  for (std::size_t t = 0; t < said.size(); ++t) {
    threads.emplace_back([&, t] {
      const auto cache = KernelCache::open(folder_, said[t]);
      Random random(t);
      for (int k = 0; k < 100; ++k) {
        const std::uint32_t number = random.below(5);
        const std::string key = "key " + std::to_string(number);
        const ObjectCode right = object(1000 + 5000 * number);
        if (t % 2 == 0) {
          cache->store(key, right, said[t]);
        } else if (const auto found = cache->load(key, interface, said[t])) {
          ASSERT_EQ(found->bytes, right.bytes);
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Diagnostics& each : said) EXPECT_EQ(each.to_string(), "");
  for (const auto& entry : fs::directory_iterator(folder_)) {
    EXPECT_TRUE(entry.path().extension() == ".kernel" || entry.path().filename() == ".secret");
  }
}

TEST(CacheFolder, FollowsXdg) {
  setenv("XDG_CACHE_HOME", "/somewhere", 1);
  EXPECT_EQ(default_cache_folder(), "/somewhere/nacre");
  setenv("XDG_CACHE_HOME", "relative", 1);
  setenv("HOME", "/home/somebody", 1);
  EXPECT_EQ(default_cache_folder(), "/home/somebody/.cache/nacre");
}

}  // namespace
}  // namespace nacre

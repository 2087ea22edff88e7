# The one list of Debian 12 packages, in groups. Sourced by install-packages.sh.

# What building and running needs.
build_packages=(
    g++ cmake ninja-build pkg-config git ca-certificates
    libeigen3-dev libexpected-dev            # vectors, result type
    libcgal-dev libtbb-dev                   # Delaunay triangulation, parallel stages
    libflatbuffers-dev flatbuffers-compiler  # MAP.vfs
    libxxhash-dev libzip-dev zipcmp zipmerge ziptool  # hashes, pk3 archives
    libassimp-dev liblzf-dev libnanoflann-dev  # meshes, compressed PCD, neighbours in point clouds
    libembree-dev                            # the exact oracle
    libcairo2-dev                            # lettering and PNG of pictures
    cyclonedds-dev cyclonedds-tools          # the wire
    libspdlog-dev nlohmann-json3-dev libcli11-dev
    libcpp-httplib-dev prometheus-cpp-dev libcurl4-openssl-dev zlib1g-dev libsystemd-dev
    libgtest-dev libgmock-dev librapidcheck-dev  # the tests, which are configured with the rest
    libqhull-dev                             # the benchmarks: the paper's Voronoi engine
)
# What the demo plays on.
map_packages=(openarena-081-maps)
# What testing needs besides.
test_packages=(clang-format-14 openarena-088-data)
# What `test.sh --all` needs besides.
lint_packages=(clang-14 clang-tidy-14 libclang-rt-14-dev)

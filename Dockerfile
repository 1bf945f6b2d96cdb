# tlab in a container, from its Debian package:
#   docker build -t tlab .
#   docker run --rm -v "$PWD:/work" tlab run /usr/share/tlab/experiments/farm.toml
FROM debian:trixie-slim AS build
WORKDIR /tlab
COPY . .
RUN .ci/install --tests && \
    git config --global --add safe.directory /tlab && \
    cmake --preset release -D BUILD_TESTING=OFF && \
    cmake --build --preset release -j "$(nproc)" --target packages

FROM debian:trixie-slim
COPY --from=build /tlab/build/release/packages/tlab_*.deb /tmp/
RUN apt-get update && \
    apt-get install -y --no-install-recommends /tmp/tlab_*.deb gnuplot-nox graphviz && \
    rm -rf /tmp/tlab_*.deb /var/lib/apt/lists/* && \
    useradd --create-home tlab
USER tlab
WORKDIR /work
ENTRYPOINT ["tlab"]

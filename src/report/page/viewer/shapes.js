// The things in the scene as three.js objects. All coordinates are mm from the aim point.

const vector = ([x, y, z]) => new THREE.Vector3(x, y, z);

/** A surface as a two-sided mesh that a section plane may cut. */
function surfaceMesh(surface, colour, clippingPlanes) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(surface.points), 3));
    geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(surface.triangles), 1));
    const material = new THREE.MeshLambertMaterial({
        color: colour,
        side: THREE.DoubleSide,
        flatShading: true,
        clippingPlanes,
        // Dots and lines on a surface stand in front of it.
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 2,
    });
    return new THREE.Mesh(geometry, material);
}

/** The body of the nozzle, its exit and the axis of the jet, to scale, wherever it stands. */
class Nozzle {
    constructor(scene) {
        this.group = new THREE.Group();
        const body = new THREE.MeshLambertMaterial({
            color: LOOK.nozzle,
            transparent: true,
            opacity: 0.45,
            depthWrite: false,
        });
        this.pieces = scene.nozzle.map((piece) => {
            const length = vector(piece.to).distanceTo(vector(piece.from));
            const mesh = new THREE.Mesh(new THREE.CapsuleGeometry(piece.radius, length, 16, 32), body);
            this.group.add(mesh);
            return mesh;
        });
        this.exit = new THREE.Mesh(
            new THREE.CircleGeometry(scene.exitRadius, 48),
            new THREE.MeshBasicMaterial({ color: 0x111111, side: THREE.DoubleSide }),
        );
        this.group.add(this.exit);
        this.reach = vector(scene.exit).length();
        this.axis = segments([0, 0, 0, 0, 0, this.reach], 0x111111, 1.2, this.reach / 24);
        this.group.add(this.axis);
        const exit = vector(scene.exit);
        const tips = scene.nozzle.map((piece) => vector(piece.to).sub(vector(piece.from)));
        this.stand(exit, vector(scene.direction), tips);
    }

    /** Puts it with its exit at a place, its jet along a direction, and the far ends of its body from the exit. */
    stand(exit, direction, tips) {
        this.pieces.forEach((mesh, index) => {
            const tip = tips[index];
            mesh.position.copy(exit).addScaledVector(tip, 0.5);
            if (tip.length() > 0) {
                mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), tip.clone().normalize());
            }
        });
        for (const thing of [this.exit, this.axis]) {
            thing.position.copy(exit);
            thing.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), direction);
        }
    }
}

/** Separate pieces of line with a width in pixels; dashed where a length of dashes is given. */
function segments(points, colour, width, dash = 0, opacity = 1) {
    const geometry = new THREE.LineSegmentsGeometry().setPositions(points);
    const material = new THREE.LineMaterial({
        color: colour,
        linewidth: width,
        dashed: dash > 0,
        dashSize: dash,
        gapSize: dash * 0.6,
        transparent: opacity < 1,
        opacity,
    });
    const lines = new THREE.LineSegments2(geometry, material);
    if (dash > 0) {
        lines.computeLineDistances();
    }
    return lines;
}

/** The ways of shots: by bounce where they keep every limit, whole where they break one. */
function pathObjects(paths, size) {
    const kept = LOOK.flights.map(() => []);
    const broken = [];
    for (const { points, breaks } of paths) {
        for (let start = 0; start + 3 < points.length; start += 3) {
            const flight = Math.min(start / 3, LOOK.flights.length - 1);
            (breaks ? broken : kept[flight]).push(...points.slice(start, start + 6));
        }
    }
    const lines = (points, ...look) => (points.length > 0 ? segments(points, ...look) : null);
    return {
        flights: kept.map((points, flight) => lines(points, LOOK.flights[flight].colour, LOOK.pathWidth, 0, 0.7)),
        breaks: lines(broken, LOOK.breaks, LOOK.breakWidth, size / 60, 0.9),
    };
}

/** Round dots whose area goes with the impulse; those that break a limit are larger and red with a dark rim. */
function dots(places, wanted, colour, size) {
    const count = places.impulse.length;
    const sizes = new Float32Array(count);
    const colours = new Float32Array(3 * count);
    const rims = new Float32Array(count);
    const plain = new THREE.Color(colour);
    const red = new THREE.Color(LOOK.breaks);
    for (let index = 0; index < count; index += 1) {
        sizes[index] = size * LOOK.dot * Math.sqrt(places.impulse[index] / wanted);
        rims[index] = places.breaks[index];
        (places.breaks[index] ? red : plain).toArray(colours, 3 * index);
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(places.points), 3));
    geometry.setAttribute("size", new THREE.BufferAttribute(sizes, 1));
    geometry.setAttribute("colour", new THREE.BufferAttribute(colours, 3));
    geometry.setAttribute("rim", new THREE.BufferAttribute(rims, 1));
    const material = new THREE.ShaderMaterial({
        uniforms: { pixels: { value: 1 } },
        vertexShader: `
            attribute float size;
            attribute vec3 colour;
            attribute float rim;
            uniform float pixels;
            varying vec3 inner;
            varying float edge;
            void main() {
                vec4 place = modelViewMatrix * vec4(position, 1.0);
                gl_Position = projectionMatrix * place;
                gl_PointSize = max(2.0, size * (1.0 + 0.6 * rim) * pixels / -place.z);
                inner = colour;
                edge = rim;
            }`,
        fragmentShader: `
            varying vec3 inner;
            varying float edge;
            void main() {
                float radius = 2.0 * length(gl_PointCoord - 0.5);
                if (radius > 1.0) discard;
                bool isRim = edge > 0.5 && radius > 0.7;
                gl_FragColor = vec4(isRim ? vec3(0.1, 0.0, 0.0) : inner, 1.0);
                #include <colorspace_fragment>
            }`,
    });
    return new THREE.Points(geometry, material);
}

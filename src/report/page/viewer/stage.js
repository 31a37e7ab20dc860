// Camera, light, drawing on demand, and the ways to move: pointer, keys, buttons.

const SURROUNDINGS = 2; // how much more is in view than target and exit
const KEY_TURN = Math.PI / 36; // per key press

class Stage {
    constructor(canvas, scene, section) {
        this.canvas = canvas;
        this.section = section;
        // The buffer is kept so that the picture can be read back, copied and printed.
        this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
        this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
        this.renderer.localClippingEnabled = true;
        this.world = new THREE.Scene();
        this.world.background = new THREE.Color(LOOK.background);
        this.camera = new THREE.PerspectiveCamera(32, 1, 0.1, 1e5);
        // The target's normal points up, as in the drawings of the sheet.
        this.camera.up.copy(vector(scene.normal));
        this.light();
        this.controls = new THREE.OrbitControls(this.camera, canvas);
        // One finger across orbits, up and down scrolls the page.
        canvas.style.touchAction = "pan-y";
        // The wheel scrolls the page until the view has been picked.
        this.controls.enableZoom = false;
        canvas.addEventListener("focus", () => (this.controls.enableZoom = true));
        canvas.addEventListener("blur", () => (this.controls.enableZoom = false));
        canvas.addEventListener("pointerdown", () => canvas.focus());
        this.controls.addEventListener("change", () => this.draw());
        this.measure(scene);
        this.afterDrawing = [];
        new ResizeObserver(() => this.fit()).observe(canvas.parentElement);
    }

    light() {
        this.world.add(new THREE.HemisphereLight(0xffffff, 0xc8ced6, 2.6));
        const lamp = new THREE.DirectionalLight(0xffffff, 1.6);
        this.camera.add(lamp);
        lamp.position.set(-0.6, 0.8, 1);
        this.world.add(this.camera);
    }

    /** What has to be in view: the target and the exit, with room around them. */
    measure(scene) {
        const exit = vector(scene.exit);
        this.middle = exit.clone().multiplyScalar(0.5);
        const target = scene.surfaces.filter((surface) => surface.role === "target");
        const reach = Math.max(0, ...target.flatMap(({ points }) => extentFrom(points, this.middle)));
        const all = scene.surfaces.flatMap(({ points }) => extentFrom(points, this.middle));
        this.far = Math.max(reach, exit.length(), ...all);
        this.near = Math.min(SURROUNDINGS * Math.max(reach, exit.length()), this.far);
        // Where there is nothing below the target, the view moves up.
        const up = vector(scene.normal);
        const extents = scene.surfaces.map(({ points }) => projectedExtent(points, up));
        const level = this.middle.dot(up);
        const low = Math.max(Math.min(...extents.map(([from]) => from)) - level, -this.near);
        const high = Math.min(Math.max(...extents.map(([, to]) => to)) - level, this.near);
        this.middle.addScaledVector(up, (low + high) / 2);
    }

    /** Looks at the cut from its open side, a little from above. */
    lookAt(middle, radius) {
        const { normal, directions } = this.section;
        const side = this.section.direction === "along" ? directions.across : directions.along;
        const towards = normal.clone().multiplyScalar(0.87);
        if (this.section.direction === "level") {
            towards.addScaledVector(directions.across, 0.4).addScaledVector(side, -0.3);
        } else {
            towards.addScaledVector(directions.level, 0.36).addScaledVector(side, -0.3);
        }
        this.controls.target.copy(middle);
        const distance = radius / Math.sin((this.camera.fov * Math.PI) / 360);
        this.camera.position.copy(middle).addScaledVector(towards.normalize(), distance);
        this.controls.update();
        this.draw();
    }

    reset() {
        this.lookAt(this.middle, this.near);
    }

    showAll() {
        this.lookAt(this.middle, this.far);
    }

    turn(leftwards, upwards) {
        this.controls.rotateLeft(leftwards * KEY_TURN);
        this.controls.rotateUp(upwards * KEY_TURN);
        this.controls.update();
        this.draw();
    }

    zoom(factor) {
        this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
        this.controls.update();
        this.draw();
    }

    fit() {
        const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
        if (width > 0 && height > 0) {
            this.renderer.setSize(width, height, false);
            this.camera.aspect = width / height;
            this.draw();
        }
    }

    /** Where a point of the scene is on the canvas, px. */
    onCanvas(point) {
        const at = point.clone().project(this.camera);
        const { clientWidth: width, clientHeight: height } = this.canvas;
        return [((at.x + 1) / 2) * width, ((1 - at.y) / 2) * height];
    }

    draw() {
        const distance = this.camera.position.distanceTo(this.controls.target);
        this.camera.near = distance / 100;
        this.camera.far = distance + 4 * this.far + 100;
        this.camera.updateProjectionMatrix();
        const height = this.renderer.domElement.height;
        const pixels = height / (2 * Math.tan((this.camera.fov * Math.PI) / 360));
        this.world.traverse((object) => {
            if (object.material?.uniforms?.pixels) {
                object.material.uniforms.pixels.value = pixels;
            }
        });
        this.renderer.render(this.world, this.camera);
        for (const follow of this.afterDrawing ?? []) {
            follow();
        }
    }
}

/** The distance of the farthest of some points, as a list of one or none. */
function extentFrom(points, middle) {
    let most = 0;
    const point = new THREE.Vector3();
    for (let start = 0; start < points.length; start += 3) {
        most = Math.max(most, point.fromArray(points, start).distanceTo(middle));
    }
    return points.length > 0 ? [most] : [];
}

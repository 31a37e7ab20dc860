// The plane that cuts surfaces open, and the line where it meets them.

class Section {
    constructor(scene, surfaces) {
        this.surfaces = surfaces;
        this.directions = {
            across: vector(scene.across),
            along: vector(scene.along),
            level: vector(scene.normal),
        };
        const jet = vector(scene.direction);
        const alongJet = Math.abs(jet.dot(this.directions.along));
        const acrossJet = Math.abs(jet.dot(this.directions.across));
        /** The plane that holds the jet as nearly as can be, so that its target is seen. */
        this.best = alongJet >= acrossJet ? "across" : "along";
        this.plane = new THREE.Plane();
        this.planes = [];
        this.outline = new THREE.Group();
        this.isOn = true;
        this.turn(this.best);
    }

    /** The direction that is cut away. */
    get normal() {
        return this.directions[this.direction];
    }

    /** Cuts across another direction, through the aim point. */
    turn(direction) {
        this.direction = direction;
        this.offset = 0;
        const extent = this.surfaces.map(({ points }) => projectedExtent(points, this.normal));
        this.from = Math.min(0, ...extent.map(([low]) => low));
        this.to = Math.max(0, ...extent.map(([, high]) => high));
        this.update();
    }

    move(offset) {
        this.offset = Math.min(Math.max(offset, this.from), this.to);
        this.update();
    }

    switch(isOn) {
        this.isOn = isOn;
        this.update();
    }

    update() {
        this.plane.normal.copy(this.normal).negate();
        this.plane.constant = this.offset;
        this.planes.length = 0;
        if (this.isOn) {
            this.planes.push(this.plane);
        }
        for (const old of this.outline.children) {
            old.geometry.dispose();
            old.material.dispose();
        }
        this.outline.clear();
        if (this.isOn) {
            const cuts = this.surfaces.filter((surface) => surface.isShown).flatMap((surface) => this.cut(surface));
            if (cuts.length > 0) {
                this.outline.add(segments(cuts, LOOK.section, LOOK.sectionWidth));
            }
        }
    }

    /** Where the triangles of a surface cross the plane. */
    cut({ points, triangles }) {
        const cuts = [];
        const height = (corner) =>
            points[3 * corner] * this.normal.x +
            points[3 * corner + 1] * this.normal.y +
            points[3 * corner + 2] * this.normal.z -
            this.offset;
        for (let start = 0; start < triangles.length; start += 3) {
            const corners = [triangles[start], triangles[start + 1], triangles[start + 2]];
            const heights = corners.map(height);
            const ends = [];
            for (let edge = 0; edge < 3; edge += 1) {
                const next = (edge + 1) % 3;
                if (heights[edge] < 0 !== heights[next] < 0) {
                    const share = heights[edge] / (heights[edge] - heights[next]);
                    for (let axis = 0; axis < 3; axis += 1) {
                        const from = points[3 * corners[edge] + axis];
                        const to = points[3 * corners[next] + axis];
                        ends.push(from + share * (to - from));
                    }
                }
            }
            if (ends.length === 6) {
                cuts.push(...ends);
            }
        }
        return cuts;
    }
}

/** Lowest and highest of some points along a direction. */
function projectedExtent(points, direction) {
    let [low, high] = [Infinity, -Infinity];
    for (let start = 0; start < points.length; start += 3) {
        const at =
            points[start] * direction.x + points[start + 1] * direction.y + points[start + 2] * direction.z;
        low = Math.min(low, at);
        high = Math.max(high, at);
    }
    return [low, high];
}

// A spiral that covers a disc evenly.

// Cosine and sine of the golden angle: the spiral's step.
const STEP: vec2<f32> = vec2<f32>(-0.73736888, 0.67549029);

fn turned(v: vec2<f32>) -> vec2<f32> {
    return vec2(v.x * STEP.x - v.y * STEP.y, v.x * STEP.y + v.y * STEP.x);
}

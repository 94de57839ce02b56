//! A state graph's weights over time: every transition goes on from the weights and rates that there are.

use super::bind::StatesNode;
use crate::Feather;

/// Which state a graph is in, and how far.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Machine {
    /// The state that it is in or goes to.
    pub(super) current: usize,
    /// The weights of all states; their sum is 1.
    pub(super) weights: Vec<f64>,
    /// Their rates, a second.
    rates: Vec<f64>,
    /// Both when the transition began.
    first_weights: Vec<f64>,
    first_rates: Vec<f64>,
    /// How long the first rates may go on, slowing down, before a weight falls below 0.
    horizon_secs: f64,
    elapsed_secs: f64,
    /// 0 if there is no transition.
    secs: f64,
    feather: Feather,
}

impl Machine {
    pub(super) fn new(node: &StatesNode) -> Machine {
        let count = node.children.len();
        let mut machine = Machine {
            current: node.initial,
            weights: vec![0.0; count],
            rates: vec![0.0; count],
            first_weights: vec![0.0; count],
            first_rates: vec![0.0; count],
            horizon_secs: 0.0,
            elapsed_secs: 0.0,
            secs: 0.0,
            feather: Feather::Smooth,
        };
        machine.weights[node.initial] = 1.0;
        machine
    }

    /// Sets out for another state.
    pub(super) fn set_out(&mut self, to: usize, secs: f64, feather: Feather) {
        self.current = to;
        self.first_weights.copy_from_slice(&self.weights);
        self.first_rates.copy_from_slice(&self.rates);
        let falling = self.weights.iter().zip(&self.rates).filter(|(_, rate)| **rate < 0.0);
        self.horizon_secs = falling.map(|(weight, rate)| weight / -rate).fold(secs, f64::min);
        self.elapsed_secs = 0.0;
        self.secs = secs;
        self.feather = feather;
    }

    /// Goes on. With u the part of the transition that has passed and s the feather curve, the weights are
    /// (1 − s(u)) (w₀ + τ r₀) + s(u) e, where e is 1 for the state that it goes to, w₀ and r₀ are the first weights
    /// and rates, and τ grows at first as time does and comes to rest at half the horizon. So values and rates go
    /// on without a jump, no weight falls below 0, and the sum stays 1, as the sum of rates is 0.
    pub(super) fn go_on(&mut self, dt_secs: f64) {
        if self.secs == 0.0 {
            return;
        }
        self.elapsed_secs += dt_secs;
        let u = self.elapsed_secs / self.secs;
        if u >= 1.0 {
            self.secs = 0.0;
            self.weights.fill(0.0);
            self.rates.fill(0.0);
            self.weights[self.current] = 1.0;
            return;
        }
        let (s, s_rate) = (self.feather.at(u), self.feather.rate(u) / self.secs);
        let (tau, tau_rate) = self.carry();
        for i in 0..self.weights.len() {
            let end = if i == self.current { 1.0 } else { 0.0 };
            let carried = self.first_weights[i] + self.first_rates[i] * tau;
            self.weights[i] = ((1.0 - s) * carried + s * end).max(0.0);
            self.rates[i] = (1.0 - s) * self.first_rates[i] * tau_rate + s_rate * (end - carried);
        }
        // The last digits.
        let sum: f64 = self.weights.iter().sum();
        self.weights.iter_mut().for_each(|weight| *weight /= sum);
    }

    /// τ and its rate.
    fn carry(&self) -> (f64, f64) {
        let (t, horizon) = (self.elapsed_secs, self.horizon_secs);
        if t >= horizon { (horizon / 2.0, 0.0) } else { (t - t * t / (2.0 * horizon), 1.0 - t / horizon) }
    }

    /// Takes over where another was, states by their names; what is in a state that there isn't any more goes
    /// to the current one, and if that is gone, nothing is taken over.
    pub(super) fn take_over(&mut self, node: &StatesNode, former: &Machine, former_node: &StatesNode) {
        let here = |s: usize| node.names.iter().position(|name| *name == former_node.names[s]);
        let Some(current) = here(former.current) else { return };
        *self = Machine { current, ..Machine::new(node) };
        self.weights.fill(0.0);
        for s in 0..former.weights.len() {
            let to = here(s).unwrap_or(current);
            self.weights[to] += former.weights[s];
            self.rates[to] += former.rates[s];
            self.first_weights[to] += former.first_weights[s];
            self.first_rates[to] += former.first_rates[s];
        }
        self.horizon_secs = former.horizon_secs;
        self.elapsed_secs = former.elapsed_secs;
        self.secs = former.secs;
        self.feather = former.feather;
    }
}

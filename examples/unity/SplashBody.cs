// SPDX-License-Identifier: MIT
// Put this on the object that is to be a body in the water: its transform is sent as poses.
using UnityEngine;

public class SplashBody : MonoBehaviour
{
    public string Body = "hand";                 // its name in the scene, with motion: {kind: osc}
    public string Host = "127.0.0.1";
    public int Port = 57300;

    SplashSocket socket;

    void OnEnable() { socket = new SplashSocket(Host, Port, false); }

    void OnDisable() { socket.Dispose(); }

    // Behind everything that moves it in this frame.
    void LateUpdate()
    {
        Vector3 p = transform.position;
        Quaternion q = transform.rotation;
        float[] pose = SplashOsc.PoseFromUnity(p.x, p.y, p.z, q.x, q.y, q.z, q.w);
        socket.Send("/body/pose", Body, pose[0], pose[1], pose[2], pose[3], pose[4], pose[5], pose[6]);
    }
}
